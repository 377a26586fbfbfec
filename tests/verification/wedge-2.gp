$d1 << EOD
-6.4887 -5
5.6328 -5
5.377 -4.0219
-5.377 4.0219
-6.4887 2.9884
-6.4887 -5

-5.377 4.0219
-3.0173 -5
6.4887 -5
6.4887 -2.9884
-1.4162 5
-4.3251 5
-5.377 4.0219

-6.4887 2.9884
1.4162 -5
4.3251 -5
5.377 -4.0219
3.0173 5
-6.4887 5
-6.4887 2.9884

-5.6328 5
-5.377 4.0219
5.377 -4.022
6.4887 -2.9884
6.4887 4.9999
3.0173 5
-5.6328 5

EOD
$d2 << EOD
-4.2869 3.9932
-4.0311 3.0151
6.723 -5.0288
7.8347 -3.9952
7.8347 3.9931
4.3633 3.9931
-4.2869 3.9932

EOD
set title "S1, planes 55/100 and 45/200: seen across the line of intersection"
set xlabel "m"
set ylabel "z, m"
set key outside top center horizontal
set size ratio -1
plot $d1 with lines lw 1.5 lc rgb 'grey' title "before", $d2 with lines lw 1.5 lc rgb 'black' title "after 1 s"
