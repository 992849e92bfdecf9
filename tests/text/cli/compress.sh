for c in none quantize meshopt draco; do
    wrlkit convert -q corpus/plant/pump_room_faces.wrl %t.$c.glb --compress $c --tolerance 0.5mm --report %t.json &&
        echo $c $(grep -oE '(KHR_mesh_quantization|EXT_meshopt_compression|KHR_draco_mesh_compression)' %t.$c.glb -a |
        sort -u) &&
        wrlkit diff corpus/plant/pump_room_faces.wrl %t.$c.glb --json |
        python3 -c "
import json,sys
d=json.load(sys.stdin)
r=json.load(open('%t.json'))['gltf']
q=r.get('quantization',{'position':0,'tolerance':0})
print(d['triangles'][0]==d['triangles'][1], d['names'], d['surface']['max']<=0.0005, q['position']<=q['tolerance'], r['bytes']['geometry']>0)"
done
