"""The materials and textures of the plant, each an Appearance that all worlds share."""
from generator import picture
from generator.vector import times
from generator.vrml import Node


def paint(name, colour, shine=0.0, texture=None, repeat=None, **more):
    material = Node('Material', diffuseColor=colour, specularColor=(shine, shine, shine) if shine else None,
                    shininess=0.4 if shine else None, **more)
    return Node('Appearance', name, material=material,
                texture=texture and Node('ImageTexture', url=[f'textures/{texture}.png']),
                textureTransform=repeat and Node('TextureTransform', scale=repeat))


CONCRETE = paint('Concrete', (0.60, 0.59, 0.56))
PLINTH = paint('Plinth_grey', (0.42, 0.44, 0.45))
WALL = paint('Wall_paint', (0.86, 0.87, 0.83))
EARTH = paint('Earth', (0.44, 0.47, 0.30))
STEEL = paint('Steel_structure', (0.30, 0.38, 0.46), 0.2)
GALVANISED = paint('Galvanised', (0.58, 0.61, 0.63), 0.4)
CAST = paint('Cast_iron', (0.36, 0.38, 0.40), 0.2)
BOLT = paint('Bolt_steel', (0.25, 0.26, 0.28), 0.5)
TANK = paint('Tank_coat', (0.78, 0.81, 0.83), 0.35)
PUMP = paint('Pump_blue', (0.10, 0.27, 0.52), 0.3)
MOTOR = paint('Motor_grey', (0.42, 0.50, 0.47), 0.25)
SAFETY = paint('Safety_yellow', (0.94, 0.74, 0.06), 0.2)
GUARD = paint('Guard_orange', (0.90, 0.42, 0.05), 0.2)
WATER = paint('Pipe_water_green', (0.08, 0.44, 0.22), 0.35)
PRESSURE = paint('Pipe_discharge_blue', (0.16, 0.42, 0.66), 0.35)
FIRE = paint('Pipe_fire_red', (0.72, 0.07, 0.06), 0.35)
AIR = paint('Pipe_air_ochre', (0.86, 0.62, 0.18), 0.35)
WHEEL = paint('Handwheel_red', (0.70, 0.10, 0.08), 0.3)
CABINET = paint('Cabinet', (0.70, 0.73, 0.68), 0.15)
FASCIA = paint('Fascia', (0.22, 0.25, 0.28), 0.1)
DIAL = paint('Dial', (0.95, 0.95, 0.92))
INK = paint('Ink', (0.05, 0.05, 0.05))
LETTER = paint('Lettering', (0.95, 0.95, 0.90), emissiveColor=(0.4, 0.4, 0.38))
CABLES = [paint(f'Cable_{name}', colour) for name, colour in
          (('black', (0.06, 0.06, 0.07)), ('grey', (0.35, 0.36, 0.38)), ('blue', (0.08, 0.16, 0.42)))]
LAMPS = [paint(f'Lamp_{name}', colour, emissiveColor=times(colour, 0.7)) for name, colour in
         (('green', (0.1, 0.8, 0.2)), ('red', (0.85, 0.1, 0.05)), ('amber', (0.95, 0.6, 0.05)))]
GLOW = paint('Lamp_glow', (1, 0.97, 0.85), emissiveColor=(1, 0.95, 0.8))
CHECKER = paint('Checker_plate', (1, 1, 1), 0.3, 'checker_plate', (4, 2))
TREAD = paint('Tread_plate', (1, 1, 1), 0.3, 'checker_plate', (4, 1))
SIGN = paint('Sign_danger', (1, 1, 1), texture='sign_danger')


# ---- textures ----------------------------------------------------------------------------------------------------

def checker_plate():
    """Raised lozenges, turned by turns; each is lit from the upper left."""
    def grey(x, y):
        cell = (x // 16 + y // 16) % 2
        u, v = x % 16 - 7.5, y % 16 - 7.5
        u, v = (u + v) / 1.414, (v - u) / 1.414
        if cell:
            u, v = v, u
        inside = 1 - abs(u) / 9 - (v / 3.2) ** 2
        if inside <= 0:
            return (150 + (x * 7 + y * 13) % 5,)
        return (190 - 14 * v * (1 if cell else -1) + 25 * inside,)
    return picture.png(picture.drawn(64, 64, grey))


def sign_danger():
    """A yellow sign: a triangle with a bolt, two lines of text."""
    dots = {}
    for text, left, top, size in (('DANGER', 52, 10, 2), ('PUMPS START', 6, 58, 2)):
        for x, y in picture.lettering(text)[0]:
            dots.update({(left + size * x + i, top + size * y + j): 1 for i in range(size) for j in range(size)})

    def colour(x, y):
        edge = min(x, y, 143 - x, 95 - y)
        ink = 1 <= edge < 4 or (x, y) in dots or warning(x - 26, y - 10)
        return (20, 20, 22) if ink else (245, 200, 20)
    return picture.png(picture.drawn(144, 96, colour))


def warning(x, y):
    """The outline of a triangle 36 high, a flash in it."""
    def within(margin):
        return y < 36 - margin and abs(x) < (y - 2 * margin) * 0.55
    flash = 14 < y < 31 and abs(x - (2 if y < 22 else -2) + (y - 22) * 0.35) < 2
    return within(0) and (not within(3) or flash)
