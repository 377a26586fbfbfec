$d1 << EOD

EOD
$d2 << EOD
0 0
0.25 0
1 2.6667
EOD
set title "Joint under 1 MN at 0.25 m from its middle"
set xlabel "place, m"
set ylabel "pressure, MPa"
set key outside top center horizontal
plot $d1 with points pt 7 ps 0.8 lc rgb '#1f77b4' title "kaya", $d2 with lines lw 1.5 dt 2 lc rgb 'black' title "closed form"
