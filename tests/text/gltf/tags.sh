# What each file says, and of how many nodes it is said when the file is read.
for extras in all facts; do
  wrlkit convert %s %t.gltf --extras $extras
  grep -o '"[a-z0-9]*","value":\["of [A-Za-z]*' %t.gltf | sort | tr '\n' ' '
  wrlkit cat --dump %t.gltf | grep -c 'value "of'
  wrlkit diff %s %t.gltf | grep surface: | sed 's/ [0-9.]*e-[01][6-9] m rms.*/ close/; s/ [0-9.]*e-[01][6-9] m.*/ close/'
done
