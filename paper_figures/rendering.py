"""Pictures of buildings: meshes that plat wrote, under a sun and a sky, drawn by POV-Ray."""

import dataclasses
import os
import shutil
import subprocess

import numpy
from figure import FigureError

SUN_DIRECTION = (0.35, -0.85, 0.8)


@dataclasses.dataclass
class Model:
    """Triangles of one colour per face, metres, z up."""

    vertices: numpy.ndarray
    faces: numpy.ndarray
    colours: numpy.ndarray

    def bounds(self):
        return self.vertices.min(axis=0), self.vertices.max(axis=0)

    def moved(self, by):
        return Model(self.vertices + numpy.asarray(by, float), self.faces, self.colours)


def read_ply(path):
    """A .ply that `plat build` (binary) or `plat parts` (text) wrote."""
    head, _, body = path.read_bytes().partition(b"end_header\n")
    lines = head.decode().splitlines()
    counts = {line.split()[1]: int(line.split()[2]) for line in lines if line.startswith("element")}
    if "format ascii 1.0" in lines:
        rows = [line.split() for line in body.decode().splitlines()]
        faces = numpy.array(rows[counts["vertex"]:counts["vertex"] + counts["face"]], float).astype(int)
        return Model(numpy.array(rows[:counts["vertex"]], float), faces[:, 1:4], faces[:, 4:7].astype("u1"))
    vertices = numpy.frombuffer(body, "<f8", 3 * counts["vertex"]).reshape(-1, 3)
    row = numpy.dtype([("n", "u1"), ("v", "<u4", 3), ("rgb", "u1", 3)])
    rows = numpy.frombuffer(body, row, counts["face"], vertices.nbytes)
    return Model(vertices, rows["v"].astype(int), rows["rgb"])


def extruded(polygon, height_m, rgb):
    """A polygon (shapely, holes left out) as a block of that height."""
    from shapely.geometry import Polygon
    from shapely.ops import triangulate

    ring = numpy.asarray(Polygon(polygon.exterior).simplify(0.2).exterior.coords)[:-1, :2]
    if numpy.cross(numpy.roll(ring, -1, 0) - ring, numpy.roll(ring, -2, 0) - ring).sum() < 0:
        ring = ring[::-1]
    n = len(ring)
    vertices = [(*p, z) for z in (0.0, height_m) for p in ring]
    faces = [f for i in range(n) for j in [(i + 1) % n] for f in ((i, j, n + j), (i, n + j, n + i))]
    shape = Polygon(ring)
    for triangle in triangulate(shape):
        if shape.contains(triangle.representative_point()):
            base = len(vertices)
            vertices += [(*p[:2], height_m) for p in triangle.exterior.coords[:3]]
            faces.append((base, base + 1, base + 2))
    return Model(numpy.array(vertices), numpy.array(faces), numpy.tile(numpy.array(rgb, "u1"), (len(faces), 1)))


@dataclasses.dataclass
class Camera:
    """Looks at `at` from `azimuth_deg` (0 = from the east, 90 = from the north)."""

    at: tuple
    distance_m: float
    azimuth_deg: float = -60.0
    elevation_deg: float = 30.0
    angle_deg: float = 28.0

    def position(self):
        azimuth, elevation = numpy.radians([self.azimuth_deg, self.elevation_deg])
        return numpy.asarray(self.at, float) + self.distance_m * numpy.array(
            [numpy.cos(elevation) * numpy.cos(azimuth), numpy.cos(elevation) * numpy.sin(azimuth), numpy.sin(elevation)])


def looking_at(models, azimuth_deg=-60.0, elevation_deg=30.0, angle_deg=28.0, room=1.05, aspect=1.5):
    """A camera that sees all of the models in a picture `aspect` times as wide as high."""
    corners = numpy.vstack([m.vertices for m in models])
    camera = Camera(tuple(0.5 * (corners.min(axis=0) + corners.max(axis=0))), 1.0, azimuth_deg, elevation_deg, angle_deg)
    backwards = camera.position() - numpy.asarray(camera.at)
    aside = numpy.cross((0, 0, 1), backwards)
    aside /= numpy.linalg.norm(aside)
    for _ in range(3):  # what is nearer is larger: the middle of the picture is found in a few steps
        seen = corners - numpy.asarray(camera.at)
        x, y, depth = seen @ aside, seen @ numpy.cross(backwards, aside), seen @ backwards
        half = numpy.tan(numpy.radians(angle_deg / 2))
        camera.distance_m = float((depth + room * numpy.maximum(abs(x) / half, abs(y) * aspect / half)).max())
        away = camera.distance_m - depth
        low, high = (y / away).min(), (y / away).max()
        left, right = (x / away).min(), (x / away).max()
        shift = 0.5 * camera.distance_m * ((low + high) * numpy.cross(backwards, aside) + (left + right) * aside)
        camera.at = tuple(numpy.asarray(camera.at) + shift)
    return camera


def render(figure, name, models, camera, width=900, height=600, marks=(), ground="<0.74,0.75,0.70>"):
    """The path of a PNG. `marks` are cylinders: (foot, height, radius, rgb)."""
    povray = shutil.which("povray")
    if povray is None:
        raise FigureError("povray is not installed; it draws the buildings (apt install povray, or "
                          "scripts/install_dependencies.sh run)")
    scene, picture = figure.path(f"{name}.pov"), figure.path(f"{name}.png")
    scene.write_text(_scene(models, camera, marks, ground), encoding="utf-8")
    threads = os.environ.get("PLAT_RENDER_THREADS", str(os.cpu_count() or 1))
    words = [povray, f"+I{scene}", f"+O{picture}", f"+W{width}", f"+H{height}", "+A0.15", "+R3", "-D", f"+WT{threads}"]
    result = subprocess.run(words, capture_output=True, text=True, check=False)
    if result.returncode != 0 or not picture.exists():
        raise FigureError(f"povray: {result.stderr.strip().splitlines()[-1] if result.stderr else 'no picture'}")
    return picture


def _vector(values):
    return "<" + ",".join(f"{v:.4f}" for v in values) + ">"


def _mesh(model):
    """One mesh2 per colour."""
    out = []
    keys = model.colours.astype(int) @ numpy.array([65536, 256, 1])
    for key in numpy.unique(keys):
        faces = model.faces[keys == key]
        used, index = numpy.unique(faces, return_inverse=True)
        points = ",".join(_vector(v) for v in model.vertices[used])
        triangles = ",".join(f"<{a},{b},{c}>" for a, b, c in index.reshape(-1, 3))
        red, green, blue = key >> 16 & 255, key >> 8 & 255, key & 255
        shine = "specular 0.35 roughness 0.02 reflection 0.12" if blue > red + 20 else ""
        out.append(f"mesh2 {{ vertex_vectors {{ {len(used)},{points} }} face_indices {{ {len(faces)},{triangles} }}\n"
                   f"  pigment {{ srgb <{red / 255:.3f},{green / 255:.3f},{blue / 255:.3f}> }} "
                   f"finish {{ ambient 0.07 diffuse 0.88 {shine} }} }}\n")
    return "".join(out)


def _scene(models, camera, marks, ground):
    sun = numpy.array(SUN_DIRECTION) * 1e5
    text = ("#version 3.7;\nglobal_settings { assumed_gamma 1.0 max_trace_level 4 }\n"
            f"camera {{ perspective location {_vector(camera.position())} sky <0,0,1> up <0,0,1> "
            f"right -x*image_width/image_height angle {camera.angle_deg:.3f} look_at {_vector(camera.at)} }}\n"
            f"light_source {{ {_vector(sun)} rgb <1.12,1.06,0.96> parallel point_at <0,0,0> }}\n"
            "light_source { <-3e4,8e4,9e4> rgb <0.26,0.29,0.36> parallel point_at <0,0,0> shadowless }\n"
            "light_source { <-7e4,-4e4,5e4> rgb <0.26,0.28,0.31> parallel point_at <0,0,0> shadowless }\n"
            "sky_sphere { pigment { gradient z color_map { [0 srgb <0.86,0.90,0.94>] [0.5 srgb <0.55,0.70,0.88>] } } }\n"
            f"plane {{ z, -0.02 pigment {{ srgb {ground} }} finish {{ ambient 0 diffuse 0.9 }} }}\n")
    for foot, height, radius, rgb in marks:
        text += (f"cylinder {{ {_vector(foot)}, {_vector((foot[0], foot[1], foot[2] + height))}, {radius} "
                 f"pigment {{ srgb {_vector(rgb)} }} finish {{ ambient 0.35 diffuse 0.65 }} }}\n")
    return text + "".join(_mesh(model) for model in models)
