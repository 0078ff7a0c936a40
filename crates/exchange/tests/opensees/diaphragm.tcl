# Two storeys in space on floors that are rigid in their planes, with a centre of mass off the middle.
model BasicBuilder -ndm 3 -ndf 6
set bays {{0 0} {6 0} {6 5} {0 5}}
geomTransf Linear 1 1 0 0
geomTransf Linear 2 0 0 1
for {set s 0} {$s <= 2} {incr s} {
    set c 1
    foreach at $bays {
        node [expr {10*$s + $c}] [lindex $at 0] [lindex $at 1] [expr {3.5*$s}]
        incr c
    }
}
fixZ 0.0 1 1 1 1 1 1
set e 1
for {set s 1} {$s <= 2} {incr s} {
    set centre [expr {10*$s + 9}]
    node $centre 3.4 2.2 [expr {3.5*$s}]
    fix $centre 0 0 1 1 1 0
    mass $centre 30000 30000 0 0 0 1.6e5
    rigidDiaphragm 3 $centre [expr {10*$s + 1}] [expr {10*$s + 2}] [expr {10*$s + 3}] [expr {10*$s + 4}]
    for {set c 1} {$c <= 4} {incr c} {
        set n [expr {10*$s + $c}]
        element elasticBeamColumn $e [expr {$n - 10}] $n 0.09 3.0e10 1.25e10 1.1e-3 6.75e-4 6.75e-4 1
        incr e
        element elasticBeamColumn $e $n [expr {$c == 4 ? 10*$s + 1 : $n + 1}] 0.12 3.0e10 1.25e10 1.5e-3 9.0e-4 1.6e-3 2
        incr e
    }
}
timeSeries Path 1 -time {0 0.3 0.6 1.0 3.0} -values {0 1 -1 0 0} -factor 3.0
pattern UniformExcitation 1 1 -accel 1
recorder Node -node 19 29 -dof 1 2 6 disp
recorder Node -node 1 -dof 1 reaction
constraints Transformation
integrator Newmark 0.5 0.25
analysis Transient
analyze 3000 0.001
