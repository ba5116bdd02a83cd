"""What Mitsuba's principled BSDF reflects, for ten materials: writes principled.csv beside this file.

    pip install mitsuba==3.9.1
    python3 principled.py

A row of seven is a material seen from one side: name, base colour, metallic, roughness, angle between view and normal
(degrees). The rows of six behind it are directions of light: angle between light and mirrored view ray and azimuth about
that ray (radians), the solid angle that the direction stands for with its mirror image (sr), and f cos of the three
channels (1/sr). Directions below the surface are left out.
"""
import math
from pathlib import Path

import mitsuba as mi

mi.set_variant("scalar_rgb")

MATERIALS = {
    "chalk": ((0.8, 0.8, 0.8), 0.0, 1.0),
    "wall": ((0.5, 0.45, 0.4), 0.0, 0.7),
    "plastic": ((0.1, 0.3, 0.7), 0.0, 0.3),
    "varnish": ((0.4, 0.2, 0.1), 0.0, 0.2),
    "soot": ((0.02, 0.02, 0.02), 0.0, 0.5),
    "gold": ((1.0, 0.766, 0.336), 1.0, 0.2),
    "brass": ((0.9, 0.75, 0.4), 1.0, 0.4),
    "iron": ((0.56, 0.57, 0.58), 1.0, 0.6),
    "lead": ((0.6, 0.6, 0.62), 1.0, 0.9),
    "worn paint": ((0.7, 0.3, 0.2), 0.5, 0.5),
}
VIEWS = (0.0, 30.0, 60.0)
POLAR, AZIMUTHS = 22, 4


def rows(base, metallic, roughness, view):
    bsdf = mi.load_dict({
        "type": "principled", "metallic": metallic, "roughness": roughness, "specular": 0.5,
        "base_color": {"type": "rgb", "value": list(base)},
    })
    sine, cosine = math.sin(math.radians(view)), math.cos(math.radians(view))
    surface = mi.SurfaceInteraction3f()
    surface.wi = mi.Vector3f(-sine, 0.0, cosine)
    mirrored, across, up = (sine, 0.0, cosine), (cosine, 0.0, -sine), (0.0, 1.0, 0.0)
    for i in range(POLAR):
        # Close together about the mirrored ray, where a lobe is narrow.
        edges = [math.pi * ((i + part) / POLAR) ** 3 for part in (0.0, 1.0)]
        alpha = 0.5 * sum(edges)
        solid = (math.cos(edges[0]) - math.cos(edges[1])) * 2.0 * math.pi / AZIMUTHS
        for j in range(AZIMUTHS):
            azimuth = math.pi * (j + 0.5) / AZIMUTHS
            turned = (math.sin(alpha) * math.cos(azimuth), math.sin(alpha) * math.sin(azimuth), math.cos(alpha))
            light = [turned[0] * a + turned[1] * b + turned[2] * c for a, b, c in zip(across, up, mirrored)]
            if light[2] > 0.0:
                value = bsdf.eval(mi.BSDFContext(), surface, mi.Vector3f(light))
                yield alpha, azimuth, solid, *(float(value[c]) for c in range(3))


def text(numbers):
    return ",".join(f"{number:.5g}" for number in numbers)


def main():
    with open(Path(__file__).with_name("principled.csv"), "w", encoding="ascii") as out:
        out.write(f"# Mitsuba {mi.__version__}, scalar_rgb, by principled.py\n")
        for name, (base, metallic, roughness) in MATERIALS.items():
            for view in VIEWS:
                out.write(f"{name},{text((*base, metallic, roughness, view))}\n")
                out.writelines(f"{text(row)}\n" for row in rows(base, metallic, roughness, view))


main()
