$d1 << EOD
-22.981 19.284
30.642 -25.712
-22.981 19.284

EOD
$d2 << EOD
0 0
7.6604 6.4279
4.4465 10.258
-3.2139 3.8302
0 0

EOD
$d3 << EOD
-1.8196 4.9949
-1.8193 4.9938
1.3921 1.1614
9.0568 7.5843
9.0565 7.5854
5.8451 11.418
-1.8196 4.9949

EOD
set title "Case 2: 5 m high, friction 20 degrees: slides"
set xlabel "x, m"
set ylabel "z, m"
set key outside top center horizontal
set size ratio -1
plot $d1 with lines lw 1.5 lc rgb 'grey' title "slope", $d2 with lines lw 1.5 lc rgb 'grey' title "before", $d3 with lines lw 1.5 lc rgb 'black' title "after 1 s"
