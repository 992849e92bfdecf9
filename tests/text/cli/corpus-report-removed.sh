set +o pipefail
mkdir -p %t.d/in
cp %S/inputs/box.wrl %t.d/in/a.wrl
cp %S/inputs/box.wrl %t.d/in/b.wrl
cp recipes/plant-web.toml %t.d/r.toml
cd %t.d
wrlkit corpus run r.toml in -q -o out > run.txt 2>&1
counts() {
  wrlkit corpus report out --looks 0 --json 2> err.txt |
    python3 -c 'import json, sys; d = json.load(sys.stdin); print(len(d["files"]), d["removed"])'
  cat err.txt
}
counts
rm in/b.wrl
counts
wrlkit corpus report out --looks 0 -q > report.txt
grep -o '<li><b>[0-9]*</b>no longer there' out/report.html
# A report of a run that came from another machine.
rm in/a.wrl
counts
