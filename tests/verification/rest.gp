$d1 << EOD
-4.8301 1.634
3.8301 -3.366
3.8301 -3.366
4.3301 -2.5
-4.3301 2.5
-4.8301 1.634

-0.59622 0.36732
-0.42301 0.26732
0.78942 -0.43268
1.2294 0.32942
0.88301 0.52942
-0.15622 1.1294
-0.59622 0.36732

EOD
$d2 << EOD
-4.8301 1.634
3.8301 -3.366
3.8301 -3.366
4.3301 -2.5
-4.3301 2.5
-4.8301 1.634

-0.59539 0.34375
-0.42241 0.24386
0.44363 -0.25617
0.79017 -0.45625
1.2302 0.30584
0.62412 0.65578
-0.15537 1.1058
-0.59539 0.34375

EOD
set title "Block of seven faces on a slope of 30 degrees, friction 35 degrees"
set xlabel "along the dip, m"
set ylabel "z, m"
set key outside top center horizontal
set size ratio -1
plot $d1 with lines lw 1.5 lc rgb 'grey' title "before", $d2 with lines lw 1.5 lc rgb 'black' title "at rest"
