mkdir %t.again && echo mine > %t.again/mine.txt
wrlkit tiles -q %S/inputs/box.wrl -o %t.again
wrlkit tiles -q %S/inputs/box.wrl -o %t.again --compress none
ls %t.again | sed 's/tiles-.*/tiles/'
ls %t.again/$(grep -o 'tiles-[0-9a-f]*' %t.again/tileset.json)
