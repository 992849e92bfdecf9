printf 'summary = "mm"\n[input]\nunit = "mm"\n[output]\ngzip = true\nprecision = 3\n[messages]\nerror = "unknown-field"\nignore = ["url-not-found"]\n' > %t.toml &&
    wrlkit convert x y.wrl --recipe %t.toml --precision 5 -p none --print-recipe
