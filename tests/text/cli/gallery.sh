mkdir -p %t/in/sub && cp %S/inputs/box.wrl %t/in/ && cp %S/inputs/box.wrl '%t/in/sub/a & "b" <i>.wrl' &&
    cp corpus/features/inline_missing.wrl %t/in/ && echo garbage > %t/in/broken.wrl
wrlkit view %t/in -o %t/page/g.html --json > %t/json 2> %t/err
echo rc $?
sed 's/"bytes":.*/"bytes":/' %t/json
cat %t/err
echo $(grep -c '<li data-name' %t/page/g.html) worlds, $(grep -c '<img width' %t/page/g.html) pictures
grep -q '<a href="../in/sub/a%20%26%20%22b%22%20%3Ci%3E.wrl">sub/a &amp; &quot;b&quot; &lt;i&gt;.wrl</a>' %t/page/g.html || grep '<a href' %t/page/g.html
grep -q "Content-Security-Policy.*default-src 'none'" %t/page/g.html || echo no policy
grep -q '12 triangles, 1 part, ' %t/page/g.html || echo no figures
