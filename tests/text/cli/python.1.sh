mkdir %t.d &&
    printf 'import wrlkit\n\n@wrlkit.pass_\ndef give_name(world, label="A"):\n    """Name the roots."""\n    for n in world.roots:\n        n.name = label\n    print("printed")\n    return {"named": len(world.roots)}\n' > %t.d/names.py &&
    printf 'python = "names.py"\n[[pass]]\nname = "give-name"\nname = "give-name"\n' > %t.d/twice.toml &&
    printf 'python = ["names.py"]\n[output]\nformat = "wrl"\n[[pass]]\nname = "give-name"\n' > %t.d/names.toml &&
    wrlkit convert %S/inputs/box.wrl %t.wrl --recipe %t.d/names.toml --stats 2>&1 |
    sed 's/^ *//' &&
    grep -o 'DEF A' %t.wrl
