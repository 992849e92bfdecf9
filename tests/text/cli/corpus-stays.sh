mkdir -p %t.d/in
cd %t.d
box() { printf '#VRML V2.0 utf8\nShape { geometry Box { size '"$1"' 1 1 } }\n' "$1"; }
printf '[[pass]]\nname = "weld"\n' > rec.toml
run() { wrlkit corpus run rec.toml "$@" 2>&1 | sed 's/; [0-9.]* s$//'; }

echo '-- links'
box 1 > in/a.wrl
run in -o o --format wrl
box 2 > in/b.wrl
box 7 > precious.wrl
ln -sf ../in/b.wrl o/a.wrl
ln -s ../precious.wrl o/b.wrl
box 3 > in/a.wrl
run in -o o --format wrl
rm o/b.wrl
ln -s ../precious.wrl o/b.wrl
run in -o o --format wrl --overwrite
grep -h size in/b.wrl precious.wrl o/a.wrl o/b.wrl

echo '-- changed by hand'
echo '# mine' >> o/a.wrl
run in -o o --format wrl
tail -1 o/a.wrl
wrlkit corpus report o --looks 0 --json 2>&1 | grep -o '^wrlkit.*\|"changed":[0-9]*,"damaged":[0-9]*'

echo '-- no longer readable'
mkdir good
box 5 > good/a.wrl
run good -o kept --format wrl
echo 'no scene' > good/a.wrl
run good -o kept --format wrl
grep size kept/a.wrl

echo '-- the folder has another name'
mkdir first
for i in 1 2 3; do box $i > first/$i.wrl; done
run first -o moved
mv first second
box 4 > second/4.wrl
run second -o moved
wrlkit corpus report moved --looks 0 --json 2>&1 | grep -o '"removed":[0-9]*\|"input":"[^"]*"'

echo '-- a damaged journal, and outputs that are gone'
sed -i '2s/.*/junk{/' moved/.wrlkit/journal-1-of-1.jsonl
rm moved/3.glb
wrlkit corpus report moved --looks 0 --json 2>&1 | grep -o '^wrlkit.*\|"changed":[0-9]*,"damaged":[0-9]*'

echo '-- two at once'
for i in $(seq 20); do box $i > second/$i.wrl; done
(run second -o both > one.txt) &
run second -o both > two.txt
wait
cat one.txt two.txt | grep -c 'failed\|cannot'
wrlkit corpus report both --looks 0 --json 2>&1 | grep -o '"removed":[0-9]*\|"changed":[0-9]*' | head -2
true
