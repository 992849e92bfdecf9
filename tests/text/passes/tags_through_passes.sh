for pass in flatten tessellate normals subdivide triangulate weld join; do
  echo $pass $(wrlkit cat --dump -p $pass %s | grep -o '"[TSGC][123]"' | sort)
done
