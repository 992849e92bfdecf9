# --report writes what --json prints, or says that it has no effect.
mkdir -p %t.d/src
cd %t.d
printf '#VRML V2.0 utf8\nShape { geometry Box { } }\n' > src/a.wrl
printf '#VRML V2.0 utf8\nShape { geometry Box { } \n' > src/b.wrl
printf '' > recipe.toml
keys() { python3 -c 'import json, sys
document = json.load(open("r.json"))
print(len(document) if isinstance(document, list) else sorted(document))'; rm -f r.json; }
wrlkit corpus plan recipe.toml src -o out --report r.json > /dev/null; keys
wrlkit corpus run -q recipe.toml src -o out --report r.json 2> /dev/null; keys
wrlkit corpus report -q out -o out.csv --looks 0 --report r.json; keys
wrlkit info src --report r.json > /dev/null 2>&1; keys
wrlkit info src/a.wrl --report r.json > /dev/null; keys
wrlkit view src -o g.html --report r.json 2> /dev/null
python3 -c 'import json
report = json.load(open("r.json"))
print(report["exit_code"], [(w["name"], w["errors"], w["messages"]) for w in report["page"]["worlds"]])'
rm r.json
for verb in passes formats 'explain Cone'; do wrlkit $verb --report r.json 2>&1 > /dev/null; done
test -e r.json || echo none
