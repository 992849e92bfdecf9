wrlkit convert --dump %t/lightmap_product.wrl %t/b.wrl -p 'lower-vrml1,lower-x3d,lightmap{quality=draft,max-size=64,format=png}' &&
    sed -n '/Shape/,/geometry/p' %t/b.wrl &&
    wrlkit convert %t/b.wrl %t/c.wrl
