# A truss of three bars; one of them yields, another works in compression alone.
model BasicBuilder -ndm 2 -ndf 2
node 1 0 0; node 2 4 0; node 3 8 0; node 4 4 3
fix 1 1 1; fix 2 1 1; fix 3 1 1
mass 4 1500 1500
uniaxialMaterial Elastic 1 2.0e11
uniaxialMaterial Steel01 2 2.5e8 2.0e11 0.02
uniaxialMaterial ENT 3 5.0e10
element truss 1 1 4 1.0e-4 2
element truss 2 2 4 2.0e-4 1
element truss 3 3 4 4.0e-4 3
timeSeries Path 1 -time {0 0.2 0.5 0.9 2.0} -values {0 1 -0.8 0.4 0} -factor 30000
pattern Plain 1 1 { load 4 1.0 -0.5 }
recorder Node -node 4 -dof 1 2 disp
analysis Transient
integrator Newmark 0.5 0.25
rayleigh 2.0 0 0 0
analyze 2000 0.0005
