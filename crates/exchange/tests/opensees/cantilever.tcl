# A column in space: bending about both axes, an offset at its top, releases of nothing.
model BasicBuilder -ndm 3 -ndf 6
node 1 0 0 0
node 2 0 0 2.5
node 3 0 0 5
fixZ 0.0 1 1 1 1 1 1
mass 3 800 800 800 50 60 40
geomTransf Linear 1 1 0 0
geomTransf Linear 2 1 0 0 -jntOffset 0 0 0 0.2 0 -0.4
section Elastic 7 2.1e11 0.012 3.0e-5 9.0e-5 8.0e10 4.0e-5
element elasticBeamColumn 1 1 2 7 1 -mass 90.0
element elasticBeamColumn 2 2 3 0.012 2.1e11 8.0e10 4.0e-5 9.0e-5 3.0e-5 2 -mass 90.0
pattern Plain 1 Constant { load 3 1000 2000 -5000 0 0 300 }
recorder Node -node 3 -dof 1 2 3 4 5 6 disp
integrator LoadControl 1
analysis Static
analyze 1
