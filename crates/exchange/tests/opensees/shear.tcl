# Four storeys of springs under a record, with damping after Rayleigh.
model BasicBuilder -ndm 1 -ndf 1
set storeys 4
set m 2.0e4
set k 3.0e7
node 0 0.0
fix 0 1
for {set i 1} {$i <= $storeys} {incr i} {
    node $i 0.0 -mass $m
    uniaxialMaterial Elastic $i [expr {$k*(1.0 - 0.1*($i - 1))}]
    element zeroLength $i [expr $i-1] $i -mat $i -dir 1 -doRayleigh 1
}
set lambda [eigen -fullGenLapack $storeys]
set w1 [expr {sqrt([lindex $lambda 0])}]
set w3 [expr {sqrt([lindex $lambda 2])}]
rayleigh [expr {0.04*2*$w1*$w3/($w1 + $w3)/2}] 0.0 [expr {0.04/($w1 + $w3)}] 0
set dt 0.01
set ag {}
for {set i 0} {$i < 400} {incr i} {
    set t [expr {$i*$dt}]
    lappend ag [expr {sin(9.0*$t)*exp(-0.5*$t) + 0.3*sin(23.0*$t)}]
}
timeSeries Path 1 -dt $dt -values $ag -factor 2.0
pattern UniformExcitation 1 1 -accel 1
recorder Node -file top.out -node $storeys -dof 1 disp
analysis Transient
integrator Newmark 0.5 0.25
set t 0.0
while {$t < 4.0 - 1e-9} {
    set ok [analyze 1 0.001]
    if {$ok != 0} { break }
    set t [expr {$t + 0.001}]
}
