"""Hostile rigs, each read in a process of its own whose memory is measured: a sentence, never more than a budget."""

import io
import json
import struct
import subprocess
import sys
import zlib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from tests.helpers.gltf import Gltf, tetrahedron
from tests.helpers.meshopt_streams import packed_tetrahedron

#: MB above what the reader takes for the smallest face.
BUDGET = 600
#: Of what the system counts a peak in, to a MB.
UNIT = 2**20 if sys.platform == "darwin" else 2**10

# Reads each rig named on the command line in a child: prints what came of it, and the child's peak in kilobytes.
READER = """
import os, sys
from pathlib import Path
from core_pipeline.errors import UserError
from core_pipeline.faces.rigs import draco
from core_pipeline.faces.open_face import open_face
import DracoPy

for name in sys.argv[1:]:
    sys.stdout.flush()
    child = os.fork()
    if not child:
        try:
            open_face(Path(name), ())
            print("a face", end=" ")
        except UserError:
            print("a sentence", end=" ")
        except BaseException as error:
            print(repr(error), end=" ")
        sys.stdout.flush()
        os._exit(0)
    _, status, used = os.wait4(child, 0)
    print(os.waitstatus_to_exitcode(status), used.ru_maxrss)
"""


def glb_of(text, data=b""):
    text += b" " * (-len(text) % 4)
    size = 12 + 8 + len(text) + 8 + len(data)
    head = struct.pack("<4sII", b"glTF", 2, size) + struct.pack("<I4s", len(text), b"JSON")
    return head + text + struct.pack("<I4s", len(data), b"BIN\0") + data


def huge_counts():
    gltf = tetrahedron()
    for accessor in gltf.json["accessors"]:
        accessor |= {"count": 2**31}
        del accessor["bufferView"]
    return gltf


def zeros_up_to_the_limits():
    """Nothing in the file, and as much announced as is allowed."""
    gltf = tetrahedron()
    gltf.json["accessors"] = [
        {"componentType": 5126, "count": 100_000, "type": "VEC3"},
        {"componentType": 5125, "count": 1_500_000, "type": "SCALAR"},
    ]
    gltf.primitive().update(attributes={"POSITION": 0}, indices=1, targets=[{"POSITION": 0}] * 220)
    gltf.mesh()["extras"] = {"targetNames": [f"s{number}" for number in range(220)]}
    return gltf


def too_many_targets():
    gltf = tetrahedron()
    primitive = gltf.primitive()
    primitive["targets"] = primitive["targets"] * 600
    gltf.mesh()["extras"] = {"targetNames": [f"s{number}" for number in range(600)]}
    for index in (primitive["attributes"]["POSITION"], primitive["targets"][0]["POSITION"]):
        accessor = gltf.json["accessors"][index]
        accessor["count"] = 1_900_000
        del accessor["bufferView"]
    return gltf


def shared_vertices():
    """Each of many primitives stands on a large set of vertices and uses three of it."""
    gltf = tetrahedron()
    primitive = gltf.primitive()
    for index in (primitive["attributes"]["POSITION"], primitive["targets"][0]["POSITION"]):
        accessor = gltf.json["accessors"][index]
        accessor["count"] = 1_900_000
        del accessor["bufferView"]
    primitive["attributes"] = {"POSITION": primitive["attributes"]["POSITION"]}
    primitive["targets"] = [{"POSITION": target["POSITION"]} for target in primitive["targets"]]
    gltf.mesh()["primitives"] = [primitive] * 16
    return gltf


def sparse_bomb():
    gltf = tetrahedron()
    gltf.sparse(4, [3], np.array([[0, 1, 0]], np.float32))
    gltf.json["accessors"][-1]["count"] = 2**33
    gltf.primitive()["targets"][0]["POSITION"] = len(gltf.json["accessors"]) - 1
    return gltf


def bind_bomb():
    gltf = tetrahedron()
    gltf.primitive()["attributes"] |= {
        "JOINTS_0": gltf.accessor(np.zeros((4, 4), np.uint8)),
        "WEIGHTS_0": gltf.accessor(np.ones((4, 4), np.float32)),
    }
    gltf.json["accessors"].append({"componentType": 5126, "count": 2**40 - 1, "type": "MAT4"})
    gltf.json["skins"] = [{"joints": [0], "inverseBindMatrices": len(gltf.json["accessors"]) - 1}]
    gltf.json["nodes"][0]["skin"] = 0
    return gltf


def image_bomb(width, height, bits=1, kind=0):
    """A PNG of one colour that announces many pixels, and keeps its word; `kind` as in PNG, 0 for grey, 6 for RGBA."""

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    rows = zlib.compressobj(9)
    body = b"".join(rows.compress(bytes(width * bits // 8 + 1)) for _ in range(height)) + rows.flush()
    head = struct.pack(">IIBBBBB", width, height, bits // (4 if kind == 6 else 1), kind, 0, 0, 0)
    png = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", body) + chunk(b"IEND", b"")
    return pictured(png)


def many_pictures(number, side):
    """Each one is small enough; all of them are not."""
    gltf = image_bomb(side, side)
    gltf.json["images"] *= number
    gltf.json["textures"] = [{"source": source} for source in range(number)]
    gltf.json["materials"] = [
        {"pbrMetallicRoughness": {"baseColorTexture": {"index": index}}} for index in range(number)
    ]
    gltf.mesh()["primitives"] = [{**gltf.primitive(), "material": index} for index in range(number)]
    return gltf


def large_webp():
    out = io.BytesIO()
    Image.new("RGB", (4096, 4096)).save(out, "WEBP", quality=1, method=0)
    return pictured(out.getvalue())


def pictured(picture):
    gltf = tetrahedron()
    places = gltf.view(np.zeros((4, 2), np.float32))
    gltf.json["accessors"].append({"bufferView": places, "componentType": 5126, "count": 4, "type": "VEC2"})
    gltf.primitive()["attributes"]["TEXCOORD_0"] = len(gltf.json["accessors"]) - 1
    gltf.primitive()["material"] = 0
    gltf.json["images"] = [{"bufferView": gltf.view(np.frombuffer(picture, np.uint8))}]
    gltf.json["textures"] = [{"source": 0}]
    gltf.json["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
    return gltf


def meshopt_bomb(count):
    """A few bytes that unpack to zeros without end."""
    gltf = packed_tetrahedron()
    view = gltf.json["bufferViews"][gltf.json["accessors"][gltf.primitive()["attributes"]["POSITION"]]["bufferView"]]
    stream = b"\xa0" + bytes(count // 4) + bytes(32)
    place = gltf.json["bufferViews"][gltf.view(np.frombuffer(stream, np.uint8))]
    view["byteLength"] = 12 * count
    view["extensions"]["EXT_meshopt_compression"].update(place, count=count, byteStride=12)
    return gltf


def draco_bomb():
    import DracoPy

    raw = bytearray(DracoPy.encode(np.eye(4, 3), np.array([[0, 1, 2], [0, 2, 3]]), preserve_order=True))
    raw[11:19] = b"\xff" * 8
    gltf = tetrahedron()
    packed = {"bufferView": gltf.view(np.frombuffer(bytes(raw), np.uint8)), "attributes": {"POSITION": 0}}
    gltf.primitive()["extensions"] = {"KHR_draco_mesh_compression": packed}
    return gltf


def nan_matrix():
    gltf = tetrahedron()
    gltf.json["nodes"][0]["matrix"] = [float("nan")] * 16
    return gltf


def circle():
    gltf = tetrahedron()
    gltf.json["nodes"] = [{"mesh": 0, "children": [1]}, {"children": [0]}]
    return gltf


def inline(size):
    """A .gltf whose one buffer stands inside its text."""
    document = tetrahedron().json
    document["buffers"] = [{"byteLength": 4, "uri": "data:application/octet-stream;base64,HERE"}]
    before, after = json.dumps(document).encode().split(b"HERE")
    return before + b"A" * size + after


FILES = {
    "huge counts.glb": huge_counts,
    "zeros up to the limits.glb": zeros_up_to_the_limits,
    "too many targets.glb": too_many_targets,
    "shared vertices.glb": shared_vertices,
    "sparse bomb.glb": sparse_bomb,
    "bind bomb.glb": bind_bomb,
    "image bomb.glb": lambda: image_bomb(20_000, 20_000),
    "large image.glb": lambda: image_bomb(8_184, 8_184),
    "large see-through image.glb": lambda: image_bomb(8_184, 8_184, 32, 6),
    "many pictures.glb": lambda: many_pictures(50, 4_096),
    "large webp.glb": large_webp,
    "base64 bomb.gltf": lambda: inline(140 * 2**20),
    "long base64.gltf": lambda: inline(100 * 2**20),
    "deep.gltf": lambda: b'{"asset": ' + b"[" * 5_000_000,
    "wide.gltf": lambda: b'{"asset": [' + b"{}," * 30_000_000,
    "many entries.glb": lambda: glb_of(b'{"asset": {"version": "2.0"}, "nodes": [' + b"{}," * 450_000 + b"{}]}"),
    "meshopt bomb.glb": lambda: meshopt_bomb(21_000_000),
    "large meshopt.glb": lambda: meshopt_bomb(4_000_000),
    "draco bomb.glb": draco_bomb,
    "nan matrix.glb": nan_matrix,
    "circle.glb": circle,
}


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    folder = tmp_path_factory.mktemp("hostile")
    paths = [folder / "plain.glb"]
    paths[0].write_bytes(tetrahedron().glb())
    for name, make in FILES.items():
        made = make()
        paths.append(folder / name)
        paths[-1].write_bytes(made.glb() if isinstance(made, Gltf) else made)
    paths.append(half_a_gigabyte(folder / "half a gigabyte.glb"))
    paths.append(long_obj(folder / "long obj"))
    root = Path(__file__).resolve().parents[4]
    done = subprocess.run(
        [sys.executable, "-c", READER, *map(str, paths)], capture_output=True, text=True, check=True, cwd=root
    )
    found = {}
    for path, line in zip(paths, done.stdout.splitlines(), strict=True):
        outcome, code, peak = line.rsplit(maxsplit=2)
        found[path.name] = outcome, int(code), int(peak) / UNIT
        path.unlink() if path.is_file() else None
    return found


def half_a_gigabyte(path):
    """A good face and 511 MB that belong to nothing; sparse on the disk."""
    whole = tetrahedron().glb()
    size = 511 * 2**20
    with path.open("wb") as file:
        file.write(whole[:8] + struct.pack("<I", size) + whole[12:])
        file.write(struct.pack("<I4s", size - len(whole) - 8, b"MORE"))
        file.truncate(size)
    return path


def long_obj(folder):
    folder.mkdir()
    with (folder / "neutral.obj").open("wb") as file:
        file.write(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        file.write(b"v 0.123456 0.123456 0.123456\n" * 1_900_000)
    with (folder / "open.obj").open("wb") as file:
        file.truncate(200 * 2**20)
    return folder


@pytest.mark.parametrize("name", [*FILES, "half a gigabyte.glb", "long obj"])
def test_memory_stays_within_its_budget(results, name):
    _, _, base = results["plain.glb"]
    outcome, code, peak = results[name]
    assert code == 0, "it ended by itself"
    assert outcome in ("a face", "a sentence")
    assert peak - base < BUDGET + (512 if name.startswith(("half", "zeros")) else 0)


def test_what_is_only_large_is_still_a_face(results):
    for name in (
        "plain.glb",
        "large image.glb",
        "large see-through image.glb",
        "many pictures.glb",
        "half a gigabyte.glb",
    ):
        assert results[name][0] == "a face", name
