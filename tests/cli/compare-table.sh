# Tables: exact by default; columns, rows and comments; tolerances by option and by file.
printf '# source: x\nt,v,w\n0,1,a\n1,2,b\n2,nan,c\n3,-4,d\n' > a.csv
printf '# source: x\nt,v,w\n0,1.001,a\n1,2.001,b\n2,NaN,c\n3,-4.5,d\n' > b.csv
printf '# source: y\nw,t,x\na,0,1\nb,1,1\n' > c.csv
printf 'column,abs,rel\n*,0,0.2\nv,0.0015,0\n' > tolerance.csv
printf 'column,abs,rel\nspeed,0,0.2\n' > wrong.csv
rasp compare a.csv a.csv
rasp compare a.csv b.csv || echo "exit $?"
rasp compare a.csv c.csv || echo "exit $?"
rasp compare -q a.csv c.csv > /dev/null || echo "exit $?"
rasp compare --abs 0.0015 --rel 0.125 a.csv b.csv
rasp compare --tolerance tolerance.csv a.csv b.csv || echo "exit $?"
rasp compare -q --tolerance tolerance.csv --column v=0.5,0.001 a.csv b.csv
rasp compare -q --column v=0.5,0 a.csv b.csv | grep -c FAIL || echo "exit $?"
rasp compare --tolerance wrong.csv a.csv b.csv || echo "exit $?"
