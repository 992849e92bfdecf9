for f in keep png jpeg webp; do
    for s in 0 32; do
        wrlkit convert -q tests/text/cli/inputs/pictures.wrl %t.glb --allow-path corpus --texture-format $f --texture-size $s --report %t.json
        python3 -c "
import json,struct
d=open('%t.glb','rb').read()
j=json.loads(d[20:20+struct.unpack_from('<I',d,12)[0]])
p=json.load(open('%t.json'))['gltf'].get('pictures',{})
print('$f $s', [i['mimeType'][6:] for i in j['images']], ['EXT_texture_webp' in t.get('extensions',{}) for t in j['textures']].count(True), 'EXT_texture_webp' in j.get('extensionsRequired',[]), p.get('reencoded'), p.get('resized'), p.get('bytes_after',0)<=p.get('bytes_before',0), p['psnr']>15 if 'psnr' in p else '')"
    done
done
