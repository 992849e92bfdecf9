for i in 1 2; do
    wrlkit compare-lod corpus/paper/ellipsoid_hole.wrl -o %t.$i.png --counts 452,200 --criteria length-normal,melax --size 32 --bare > %t.out
done
cmp %t.1.png %t.2.png &&
    python3 -c "
import struct
print(struct.unpack('>II', open('%t.1.png', 'rb').read()[16:24]))"
