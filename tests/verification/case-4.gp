$d1 << EOD
-22.981 19.284
30.642 -25.712
-22.981 19.284

EOD
$d2 << EOD
0 0
7.6604 6.4279
-8.4092 25.579
-16.07 19.151
0 0

EOD
$d3 << EOD
-13.716 22.671
-0.71677 1.3187
-0.63287 1.2329
7.9085 6.4333
-5.0912 27.786
-5.1751 27.872
-13.716 22.671

EOD
set title "Case 4: 25 m high, friction 24 degrees: slides and topples"
set xlabel "x, m"
set ylabel "z, m"
set key outside top center horizontal
set size ratio -1
plot $d1 with lines lw 1.5 lc rgb 'grey' title "slope", $d2 with lines lw 1.5 lc rgb 'grey' title "before", $d3 with lines lw 1.5 lc rgb 'black' title "after 1 s"
