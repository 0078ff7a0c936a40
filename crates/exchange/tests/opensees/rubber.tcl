# A mass on two elastomeric bearings, one bilinear, the other after Bouc and Wen.
model BasicBuilder -ndm 3 -ndf 6
node 1 0 0 0; node 2 0 0 0
fix 1 1 1 1 1 1 1
fix 2 0 0 0 1 1 1
mass 2 50000 50000 50000 0 0 0
uniaxialMaterial Elastic 1 5.0e8
uniaxialMaterial Elastic 2 1.0e4
set orient {-orient 0 0 1 1 0 0}
element elastomericBearingPlasticity 1 1 2 1.0e7 2.0e4 0.1 0.0 1.0 -P 1 -T 2 -My 2 -Mz 2 {*}$orient
element elastomericBearingBoucWen 2 1 2 1.2e7 1.5e4 0.08 0.0 1.0 1.0 0.5 0.5 -P 1 -T 2 -My 2 -Mz 2 {*}$orient
recorder Node -node 2 -dof 1 2 disp
timeSeries Trig 2 0 3.0 1.0 -factor 2.0
timeSeries Trig 3 0 3.0 0.7 -factor 1.2
pattern UniformExcitation 2 1 -accel 2
pattern UniformExcitation 3 2 -accel 3
integrator Newmark 0.5 0.25
analysis Transient
analyze 20000 0.0002
