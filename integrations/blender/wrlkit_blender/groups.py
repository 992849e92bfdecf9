"""Collections: of the file, of its named groups, of its coarser levels of detail."""
import bpy


def _move(o, collection):
    for c in list(o.users_collection):
        c.objects.unlink(o)
    collection.objects.link(o)


def _below(o):
    return [o] + [d for child in o.children for d in _below(child)]


def collect(context, name, objects, levels, by_names):
    """Puts all objects ({node: object}) into a new collection; by_names: named groups of the file are collections in it. Coarser
    levels ({node: number}) go into hidden ones, one a number."""
    top = bpy.data.collections.new(name)
    context.scene.collection.children.link(top)
    coarser = {o: levels[i] for i, k in objects.items() if i in levels for o in _below(k)}
    own = set(objects.values())

    def visit(o, collection):
        if o in coarser:
            return
        if by_names and o.type == 'EMPTY' and o.children and not o.name.startswith('Node_'):
            inner = bpy.data.collections.new(o.name)
            collection.children.link(inner)
            collection = inner
        _move(o, collection)
        for child in o.children:
            visit(child, collection)

    for o in objects.values():
        if o.parent not in own:
            visit(o, top)
    if coarser:
        _hide(name, top, coarser)


def _hide(name, top, coarser):
    hidden = bpy.data.collections.new(f'{name} levels')
    hidden.hide_viewport = hidden.hide_render = True
    top.children.link(hidden)
    for number in sorted(set(coarser.values())):
        level = bpy.data.collections.new(f'{name} level {number}')
        hidden.children.link(level)
        for o, n in coarser.items():
            if n == number:
                _move(o, level)
