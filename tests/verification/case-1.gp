$d1 << EOD
-22.981 19.284
30.642 -25.712
-22.981 19.284

EOD
$d2 << EOD
0 0
7.6604 6.4279
1.2326 14.088
-6.4279 7.6604
0 0

EOD
$d3 << EOD
-6.381 7.7471
0.0053012 0.051986
0.031746 0.030312
7.7268 6.4167
1.3406 14.112
1.3141 14.133
-6.381 7.7471

EOD
set title "Case 1: 10 m high, friction 40.1 degrees: stands"
set xlabel "x, m"
set ylabel "z, m"
set key outside top center horizontal
set size ratio -1
plot $d1 with lines lw 1.5 lc rgb 'grey' title "slope", $d2 with lines lw 1.5 lc rgb 'grey' title "before", $d3 with lines lw 1.5 lc rgb 'black' title "after 1 s"
