wrlkit convert -q --names table --extras facts --compress meshopt %s %t.glb \
    -p 'recognise,cull{hidden=true,rays=16},dedup,instance{forms=true},merge{instanced=true}' && echo done
