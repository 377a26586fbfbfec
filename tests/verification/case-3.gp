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
-13.697 22.71
-0.86759 1.2552
-0.75598 1.1689
7.8261 6.3016
-5.0033 27.756
-5.1149 27.842
-13.697 22.71

EOD
set title "Case 3: 25 m high, friction 40 degrees: topples"
set xlabel "x, m"
set ylabel "z, m"
set key outside top center horizontal
set size ratio -1
plot $d1 with lines lw 1.5 lc rgb 'grey' title "slope", $d2 with lines lw 1.5 lc rgb 'grey' title "before", $d3 with lines lw 1.5 lc rgb 'black' title "after 1 s"
