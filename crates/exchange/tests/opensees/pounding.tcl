# Two buildings with a joint: they pound under a pulse.
model BasicBuilder -ndm 2 -ndf 3
node 1 0 0; node 2 1 0
node 11 0 3 -mass 2.0e4 0 0
node 12 1 3 -mass 3.0e4 0 0
fix 1 1 1 1; fix 2 1 1 1; fix 11 0 1 1; fix 12 0 1 1
uniaxialMaterial Elastic 1 8.0e5 6.0e3
uniaxialMaterial Elastic 2 4.8e6 1.2e4
uniaxialMaterial ViscoelasticGap 3 5.0e7 1.0e5 -0.02
element twoNodeLink 1 1 11 -mat 1 -dir 2
element twoNodeLink 2 2 12 -mat 2 -dir 2
element twoNodeLink 3 11 12 -mat 3 -dir 1
timeSeries Trig 1 0 0.6 0.6 -factor 4.0
pattern UniformExcitation 1 1 -accel 1
recorder Node -node 11 12 -dof 1 disp
recorder Element -ele 3 deformation
analysis Transient
integrator Newmark 0.5 0.25
analyze 30000 0.0001
