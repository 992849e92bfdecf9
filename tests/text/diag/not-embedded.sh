mkdir -p %t/in %t/out
printf '#VRML V2.0 utf8\nPROTO Lamp [ ] { Shape { geometry Sphere { } } }\n' > %t/in/lib.wrl
printf '#VRML V2.0 utf8\nEXTERNPROTO Lamp [ ] "lib.wrl#Lamp"\nLamp { }\nLamp { }\n' > %t/in/w.wrl
wrlkit convert %t/in/w.wrl %t/out/w.wrl --embed
ls %t/out/w_files
