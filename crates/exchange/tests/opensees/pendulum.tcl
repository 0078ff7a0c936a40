# A mass on a single friction pendulum, friction by speed.
model BasicBuilder -ndm 3 -ndf 6
node 1 0 0 0; node 2 0 0 0
fix 1 1 1 1 1 1 1
fix 2 0 0 0 1 1 1
mass 2 20000 20000 20000 0 0 0
frictionModel VelDependent 1 0.04 0.08 20.0
uniaxialMaterial Elastic 1 2.0e9 2.0e6
uniaxialMaterial Elastic 2 1.0
element singleFPBearing 1 1 2 1 2.0 1.0e8 -P 1 -T 2 -My 2 -Mz 2 -orient 0 0 1 1 0 0 -iter 50 1e-8
pattern Plain 1 Linear { load 2 0 0 -196200 0 0 0 }
recorder Node -node 2 -dof 1 2 disp
integrator LoadControl 0.1
analysis Static
analyze 10
loadConst -time 0
timeSeries Trig 2 0 3.0 1.5 -factor 1.6
timeSeries Trig 3 0 3.0 1.0 -factor 0.8
pattern UniformExcitation 2 1 -accel 2
pattern UniformExcitation 3 2 -accel 3
integrator Newmark 0.5 0.25
analysis Transient
analyze 30000 0.0002
