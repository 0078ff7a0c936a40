# A block on two flat sliders, pressed by its weight.
model BasicBuilder -ndm 2 -ndf 3
node 1 -1 0; node 2 1 0; node 3 -1 0; node 4 1 0; node 5 0 0
fix 1 1 1 1; fix 2 1 1 1
mass 5 10000 10000 5000
rigidLink beam 5 3
rigidLink beam 5 4
frictionModel Coulomb 1 0.08
uniaxialMaterial Elastic 1 1.0e8 1.0e5
uniaxialMaterial Elastic 2 0.0
element flatSliderBearing 1 1 3 1 2.0e7 -P 1 -Mz 2 -orient 0 1 0 -1 0 0
element flatSliderBearing 2 2 4 1 2.0e7 -P 1 -Mz 2 -orient 0 1 0 -1 0 0
pattern Plain 1 Linear { load 5 0 -98100 0 }
recorder Node -node 5 -dof 1 2 3 disp
constraints Transformation
integrator LoadControl 0.1
analysis Static
analyze 10
loadConst -time 0
timeSeries Trig 2 0 2.0 0.8 -factor 2.5
pattern UniformExcitation 2 1 -accel 2
integrator Newmark 0.5 0.25
analysis Transient
analyze 20000 0.0002
