wrlkit render %t.d/b.wrl %S/absent.wrl %t.two.png --width 60 --height 40 --report %t.json 2> %t.err
echo $?
grep -c cannot-read %t.err
grep -o '"drawn":[a-z]*' %t.json
head -c 24 %t.two.png | tail -c 8 | od -An -tu1 | xargs
