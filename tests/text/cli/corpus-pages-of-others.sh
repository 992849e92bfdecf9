exec 2>&1
mkdir -p %t.d/in
cd %t.d
printf '[[pass]]\nname = "weld"\n' > r.toml
printf '#VRML V2.0 utf8\nShape { geometry Box { } }\n' > in/a.wrl
printf 'precious' > notes.txt
wrlkit corpus run -q r.toml in -o out --joblog notes.txt || echo "exit code $?"
cat notes.txt && echo
wrlkit corpus run -q r.toml in -o out --joblog log
wrlkit corpus run -q r.toml in -o out --joblog log
wc -l < log
echo '<title>Mine</title>' > out/report.html
wrlkit corpus report out --looks 0 || echo "exit code $?"
cat out/report.html
rm out/report.html
wrlkit corpus report out --looks 0
wrlkit corpus report out --looks 0
