$d1 << EOD
-17.138 -24
85.689 -24
85.689 60
-17.138 -12
-17.138 -24

0 0
85.689 60
50.346 60
0 0

EOD
$d2 << EOD
-17.138 -24
85.689 -24
85.689 60
-17.138 -12
-17.138 -24

-9.9609 -6.9748
-9.9609 -6.9748
75.728 53.025
75.728 53.025
40.385 53.025
-9.9609 -6.9748

EOD
set title "Slab of S3 with friction 20 degrees and no cohesion"
set xlabel "x, m"
set ylabel "z, m"
set key outside top center horizontal
set size ratio -1
plot $d1 with lines lw 1.5 lc rgb 'grey' title "before", $d2 with lines lw 1.5 lc rgb 'black' title "after 3 s"
