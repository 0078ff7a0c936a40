# An oscillator between a stop and a cable with slack, and a dashpot of the power 0.5.
model BasicBuilder -ndm 1 -ndf 1
node 1 0; node 2 0 -mass 1000
fix 1 1
uniaxialMaterial Elastic 1 4.0e5
uniaxialMaterial ElasticPPGap 2 3.0e6 -1.0e9 -0.01
uniaxialMaterial ElasticPPGap 3 1.0e6 1.0e9 0.02
uniaxialMaterial Viscous 4 2000.0 0.5
element zeroLength 1 1 2 -mat 1 2 3 4 -dir 1 1 1 1
timeSeries Trig 1 0 1.0 0.25 -factor 6.0
pattern UniformExcitation 1 1 -accel 1
recorder Node -node 2 -dof 1 disp
recorder Node -node 2 -dof 1 vel
analysis Transient
integrator Newmark 0.5 0.25
analyze 20000 0.0001
