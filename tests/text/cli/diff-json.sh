python3 -c "print('#VRML V2.0 utf8 DEF G0 Shape { geometry Box { } }'.replace('utf8', 'utf8' + chr(10)), *(f'DEF G{i + 1} Group {{ children [ USE G{i} USE G{i} ] }}' for i in range(22)))" > %t.wrl
wrlkit diff %S/inputs/box.wrl %t.wrl --json
