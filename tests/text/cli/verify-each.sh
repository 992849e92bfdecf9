for out in glb wrl; do
    for p in normals triangulate,tessellate lod,normals,tessellate,inline,normals,join; do
        wrlkit convert %S/inputs/pipes.wrl %t.$out -p $p --verify-each > /dev/null
        echo $?
    done
done | uniq
