pass=lightmap{quality=draft,max-size=64
wrlkit convert tests/text/diag/inputs/dim.wrl %t.wrl -p "$pass,exposure=auto}" 2>&1 | sed 's/[0-9][0-9.]*/F/g'
factor=$(sed -n 's/.*"lightmap exposure \([0-9.]*\)".*/\1/p' %t.wrl)
grep -o '"lightmap exposure [0-9]' %t.wrl | sed 's/[0-9]/F"/'
wrlkit convert tests/text/diag/inputs/dim.wrl %t.again.wrl -p "$pass,exposure=$factor}" && sed 's/again[.]//' %t.again.wrl | cmp - %t.wrl && echo the same
wrlkit render tests/text/diag/inputs/dim.wrl %t.png --mode path --exposure auto --samples 1 --width 16 --height 16 2>&1 |
    sed 's/[0-9][0-9.]*/F/g'
