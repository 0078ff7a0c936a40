# A portal frame: gravity, then a motion of its ground.
wipe
model BasicBuilder -ndm 2 -ndf 3
set E 2.0e11
set width 6.0
set height 4.0
foreach {tag x y} "1 0 0  2 $width 0  3 0 $height  4 $width $height" { node $tag $x $y }
fix 1 1 1 1
fix 2 1 1 1
mass 3 5000 5000 1.0
mass 4 5000 5000 1.0
geomTransf Linear 1
proc member {tag i j {area 0.01} {inertia 2.0e-5}} {
    global E
    element elasticBeamColumn $tag $i $j $area $E $inertia 1
}
member 1 1 3
member 2 2 4
member 3 3 4 0.02 1.0e-4
pattern Plain 1 Linear {
    load 3 0.0 -49050.0 0.0
    load 4 0.0 -49050.0 0.0
    eleLoad -ele 3 -type -beamUniform -2000.0
}
recorder Node -file disp.out -time -node 3 4 -dof 1 2 3 disp
recorder Element -file column.out -time -ele 1 force
constraints Plain; numberer RCM; system BandGeneral
test NormDispIncr 1e-10 10
algorithm Newton
integrator LoadControl 0.1
analysis Static
analyze 10
loadConst -time 0.0
set w2 [eigen 2]
set w1 [expr sqrt([lindex $w2 0])]
set w2 [expr {pow([lindex $w2 1], 0.5)}]
set zeta 0.05
rayleigh [expr 2*$zeta*$w1*$w2/($w1+$w2)] 0.0 [expr 2.0*$zeta/($w1+$w2)] 0.0
timeSeries Trig 2 0.0 2.0 0.5 -factor 1.5
pattern UniformExcitation 2 1 -accel 2
integrator Newmark 0.5 0.25
analysis Transient
analyze 2000 0.002
