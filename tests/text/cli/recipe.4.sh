printf '[[pass]]\nname = "merge"\ncsv = "a,{b.csv"\n' > %t.toml
wrlkit convert x y.glb --recipe %t.toml --print-pipeline | tee %t.pipeline | grep -o 'csv=.*csv"'
wrlkit convert x y.glb -p "$(< %t.pipeline)" --print-pipeline | cmp - %t.pipeline && echo same
