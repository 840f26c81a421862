#!/usr/bin/env python3
"""Writes the seeds of the fuzz targets: tests/fuzz/corpus/NAME/, each below 4 KB.

Run it after adding a seed below; it writes the same bytes every time and leaves other files of the
corpus alone (inputs that once failed are kept there as regress_*). Everything is made here from
numbers; nothing is copied from anywhere.
"""
import bz2
import gzip
import json
import pathlib
import struct
import zlib

CORPUS = pathlib.Path(__file__).resolve().parent / "corpus"


def put(target, name, data):
    folder = CORPUS / target
    folder.mkdir(parents=True, exist_ok=True)
    data = data.encode() if isinstance(data, str) else data
    assert len(data) < 4096, name
    (folder / name).write_bytes(data)


def squeeze(data):
    return gzip.compress(data, mtime=0)


BYTES = bytes(range(24))  # 2 x 3 x 4 voxels
SHORTS = struct.pack("<24h", *range(-100, 1100, 50))
FLOATS = struct.pack("<24f", *[i / 7 for i in range(22)], float("nan"), float("inf"))


def nrrd():
    def header(kind, encoding, sizes="2 3 4", more=""):
        count = len(sizes.split())
        return (f"NRRD0004\n# made by hand\ntype: {kind}\ndimension: {count}\nsizes: {sizes}\n"
                f"encoding: {encoding}\n{more}\n").encode()

    space = ("space: left-posterior-superior\nspace directions: (1,0,0) (0,0,2) (0,-1.5,0)\n"
             "space origin: (10,-20,30)\nspace units: \"mm\" \"mm\" \"mm\"\n")
    put("nrrd", "raw", header("uint8", "raw", more=space) + BYTES)
    put("nrrd", "short_big", header("short", "raw", more="endian: big\nspacings: 1 2 3\n") + SHORTS)
    put("nrrd", "float", header("float", "raw", more="endian: little\n" + space) + FLOATS)
    put("nrrd", "double", header("double", "raw", "2 1 1", "endian: little\n") +
        struct.pack("<2d", 1e300, -1))
    put("nrrd", "ascii", header("int", "ascii", "2 2 2") + b"1 2 3 4 5 6 7 -8\n")
    put("nrrd", "hex", header("uchar", "hex", "2 2 1") + b"00ff10a0\n")
    put("nrrd", "gzip", header("uint8", "gzip", more="line skip: 0\nbyte skip: 0\n") +
        squeeze(BYTES))
    put("nrrd", "gzip_skip", header("uint8", "gzip", more="byte skip: 4\n") +
        squeeze(b"skip" + BYTES))
    put("nrrd", "gzip_end", header("uint8", "gzip", more="byte skip: -3\n") +
        squeeze(b"junk" + BYTES + b"xy"))
    put("nrrd", "gzip_lines", header("uint8", "gzip", more="line skip: 2\n") + b"one\ntwo\n" +
        squeeze(BYTES))
    put("nrrd", "bzip2_end", header("uint8", "bzip2", more="byte skip: -1\n") +
        bz2.compress(b"junk" + BYTES))
    put("nrrd", "raw_end", header("uint8", "raw", more="byte skip: -1\n") + b"junk" + BYTES)
    put("nrrd", "bzip2", header("uint8", "bzip2") + bz2.compress(BYTES))
    put("nrrd", "rgb", header("uint8", "raw", "3 2 2 2", "kinds: RGB-color space space space\n"
                              "space: RAS\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\n") +
        BYTES)
    put("nrrd", "list", header("uint8", "raw", "2 3 2 2", "kinds: domain domain domain list\n"
                               "space dimension: 3\n"
                               "old min: 0\nold max: 9\nmeasurement frame: (1,0,0)\nkey:=value\n")
        + BYTES)
    put("nrrd", "image", header("uint8", "raw", "4 6", "content: flat\ncenters: cell node\n"
                                "axis mins: 0 0\naxis maxs: 1 1\nlabels: \"x\" \"y\"\n") + BYTES)
    # teem loses memory over these; they must not reach it.
    put("nrrd", "regress_kinds_first", "NRRD0004\nkinds: domain\ndimension: 1\nsizes: 1\n")
    put("nrrd", "regress_newline", "NRRD0004\nkinds: 3\nspace: RAS\n")
    put("nrrd", "regress_quote", header("uint8", "raw", more='labels: "a" "b" "c\n') + BYTES)
    put("nrrd", "regress_space_units", header("uint8", "raw", more=space +
                                              'space units: "a" "b" "c" "d"\n') + BYTES)
    put("nrrd", "regress_kind_size", header("uint8", "raw", "6 2 2 2",
                                            "kinds: RGB-color space space space\n") + BYTES * 2)
    put("nrrd", "regress_magic", "NRRD000O = Image\nMM nan 8\n")
    put("nrrd", "regress_return", "NRRD0004\ntype: uint8\rdata file: LIST\n")
    put("nrrd", "regress_zero", b"NRRD0004\n# \0\ndata file: %s%s%d 1 2 1\n")
    put("nrrd", "regress_gzip", header("uint8", "gzip") + squeeze(BYTES)[:-12] + bytes(12))
    put("nrrd", "regress_bzip2", header("uint8", "bzip2") + bz2.compress(BYTES)[:-4] + bytes(4))
    put("nrrd", "detached", header("uint8", "raw", more="data file: nowhere.raw\n"))
    put("nrrd", "detached_list", header("uint8", "raw", more="data file: part%02d.raw 1 4 1\n"))


def nifti_header(version, dims, code, bits, order="<", **more):
    dim = ([len(dims)] + list(dims) + [1] * 7)[:8]
    pixdim = ([-1.0, 1.5, 2.0, 2.5] + [1.0] * 4)
    qform, sform = more.get("qform", 1), more.get("sform", 0)
    rows = (1.5, 0, 0, more.get("origin", -10), 0, 2, 0.1, -20, 0, -0.1, 2.5, 5)
    slope, inter = more.get("slope", 2.0), more.get("inter", -3.0)
    if version == 1:
        offset = more.get("offset", 352.0)
        return (struct.pack(order + "i10s18sih2b8h", 348, b"", b"", 0, 0, 114, 0, *dim) +
                struct.pack(order + "3f4h8f3fhbbffffii", 0, 0, 0, 0, code, bits, 0, *pixdim, offset,
                            slope, inter, 0, 0, 2, 0, 0, 0, 0, 0, 0) +
                struct.pack(order + "80s24shh6f12f16s4s", b"seed", b"", qform, sform, 0.1, 0.2, 0.3,
                            1, 2, 3, *rows, b"", more.get("magic", b"n+1\0")))
    return (struct.pack(order + "i8shh8q3d8d", 540, b"n+2\0\r\n\x1a\n", code, bits, *dim, 0, 0, 0,
                        *pixdim) +
            struct.pack(order + "qddddddqq80s24sii6d12d", 544, slope, inter, 0, 0, 0, 0, 0, 0,
                        b"seed", b"", qform, sform, 0.1, 0.2, 0.3, 1, 2, 3, *rows) +
            struct.pack(order + "iii16sb15s", 0, 2, 0, b"", 0, b""))


def nifti():
    none = bytes(4)
    put("nifti", "u8", nifti_header(1, (2, 3, 4), 2, 8) + none + BYTES)
    put("nifti", "i16_sform", nifti_header(1, (2, 3, 4), 4, 16, sform=2) + none + SHORTS)
    put("nifti", "i16_big", nifti_header(1, (2, 3, 4), 4, 16, ">") + none + SHORTS)
    put("nifti", "float_4d", nifti_header(1, (2, 3, 2, 2), 16, 32, slope=0.0) + none + FLOATS)
    put("nifti", "rgb", nifti_header(1, (2, 2, 2), 128, 24) + none + BYTES)
    put("nifti", "rgba", nifti_header(1, (2, 3, 1), 2304, 32) + none + BYTES)
    put("nifti", "double", nifti_header(1, (3, 1, 1), 64, 64) + none + struct.pack("<3d", 1, 2, 3))
    put("nifti", "bits", nifti_header(1, (8, 3, 1), 1, 1) + none + b"abc")
    put("nifti", "complex", nifti_header(1, (3, 1, 1), 32, 64) + none + BYTES)
    put("nifti", "version2", nifti_header(2, (2, 3, 4), 2, 8, sform=1) + none + BYTES)
    put("nifti", "gzip", squeeze(nifti_header(1, (2, 3, 4), 2, 8) + none + BYTES))
    put("nifti", "pair", nifti_header(1, (2, 3, 4), 2, 8, magic=b"ni1\0", offset=0.0) + BYTES)
    put("nifti", "regress_infinite", nifti_header(1, (2, 3, 4), 2, 8, sform=1, origin=float("inf")) + none +
        BYTES)
    put("nifti", "extension", nifti_header(1, (2, 3, 4), 2, 8, offset=384.0) + b"\1\0\0\0" +
        struct.pack("<ii24s", 32, 6, b"a comment") + BYTES)


def metaimage():
    def header(kind, more="", dims="2 3 4", count=3):
        return (f"ObjectType = Image\nNDims = {count}\nDimSize = {dims}\nElementType = {kind}\n"
                f"{more}ElementDataFile = LOCAL\n").encode()

    place = ("BinaryData = True\nBinaryDataByteOrderMSB = False\nElementSpacing = 1 2 3\n"
             "Offset = -1 -2 -3\nTransformMatrix = 0 1 0 -1 0 0 0 0 1\nCenterOfRotation = 0 0 0\n"
             "AnatomicalOrientation = RAI\n")
    put("metaimage", "u8", header("MET_UCHAR", place) + BYTES)
    put("metaimage", "i16_big", header("MET_SHORT", "ElementByteOrderMSB = True\n") + SHORTS)
    put("metaimage", "float", header("MET_FLOAT", place) + FLOATS)
    put("metaimage", "rgb", header("MET_UCHAR", "ElementNumberOfChannels = 3\n", "2 2 2") + BYTES)
    put("metaimage", "ascii", header("MET_INT", "BinaryData = False\n", "2 2 2") +
        b"1 2 3 4 5 6 7 8\n")
    packed = zlib.compress(BYTES)
    put("metaimage", "zlib", header("MET_UCHAR", "CompressedData = True\n"
                                    f"CompressedDataSize = {len(packed)}\n") + packed)
    put("metaimage", "header_size", header("MET_UCHAR", "HeaderSize = -1\n") + BYTES)
    put("metaimage", "four", header("MET_UCHAR", place, "2 3 2 2", 4) + BYTES)
    put("metaimage", "list", b"ObjectType = Image\nNDims = 3\nDimSize = 2 3 2\n"
        b"ElementType = MET_UCHAR\nElementDataFile = LIST\na.raw\nb.raw\n")


def raw():
    def seed(name, data, **sidecar):
        put("raw", name, json.dumps(sidecar).encode() + b"\0" + data)

    seed("u8", BYTES, dims=[2, 3, 4], type="uint8")
    seed("all", b"head" + SHORTS, dims=[2, 3, 4], type="int16", spacing=[1, 2, 3], offset=4,
         origin=[4, 5, 6], endian="big", slope=2, intercept=-1024, unit="HU", space="by hand",
         labels=True)
    seed("matrix", FLOATS, dims=[2, 3, 4], type="float32",
         world_from_voxel=[[0, 1, 0, 5], [1, 0, 0, 6], [0, 0, 2, 7], [0, 0, 0, 1]])
    seed("rgba", BYTES, dims=[6, 1, 1], type="rgba8")


def tiff_file(pages, order="<", big=False):
    """Pages are lists of (tag, type, values) and the blocks (strips or tiles) of the picture."""
    size = {1: "B", 2: "s", 3: "H", 4: "I", 5: "I", 11: "f", 12: "d", 16: "Q"}
    mark = b"II" if order == "<" else b"MM"
    data = bytearray(mark + (struct.pack(order + "HHHQ", 43, 8, 0, 16) if big else
                             struct.pack(order + "HI", 42, 8)))
    word, width = ("Q", 8) if big else ("I", 4)
    for index, (tags, blocks) in enumerate(pages):
        tiled = any(tag == 322 for tag, _, _ in tags)
        tags = tags + [(324 if tiled else 273, 16 if big else 4, [0] * len(blocks)),
                       (325 if tiled else 279, 4, [len(block) for block in blocks])]
        start = len(data)
        length = (8 if big else 2) + len(tags) * (20 if big else 12) + width
        place = start + length
        body, entries = bytearray(), b""
        offsets = []
        for block in blocks:
            offsets.append(place + len(body))
            body += block
        for tag, kind, values in sorted(tags):
            if tag in (273, 324):
                values = offsets
            if kind == 2:
                packed, count = values, len(values)
            else:
                packed = b"".join(struct.pack(order + size[kind], v) for v in values)
                count = len(values) // 2 if kind == 5 else len(values)
            if len(packed) > width:
                offset, body = place + len(body), body + packed
                packed = struct.pack(order + word, offset)
            entries += struct.pack(order + "HH" + word, tag, kind, count) + packed.ljust(width, b"\0")
        following = 0 if index == len(pages) - 1 else place + len(body)
        data += struct.pack(order + ("Q" if big else "H"), len(tags)) + entries
        data += struct.pack(order + word, following) + body
    return bytes(data)


def packbits(data):
    return b"".join(bytes([len(data[i:i + 128]) - 1]) + data[i:i + 128]
                    for i in range(0, len(data), 128))


def tiff():
    def page(bits=8, samples=1, compression=1, form=1, width=4, height=3, photometric=None, more=()):
        photometric = photometric if photometric is not None else 2 if samples > 2 else 1
        tags = [(256, 3, [width]), (257, 3, [height]), (258, 3, [bits] * samples),
                (259, 3, [compression]), (262, 3, [photometric]), (277, 3, [samples]),
                (278, 3, [height]), (284, 3, [1]), (339, 3, [form] * samples)]
        return [tag for tag in tags if tag[0] not in [m[0] for m in more]] + list(more)

    plane = BYTES[:12]
    put("tiff", "stack", tiff_file([(page(), [plane]), (page(), [plane[::-1]])]))
    put("tiff", "u16_big", tiff_file([(page(16), [SHORTS[:24]])], ">"))
    put("tiff", "float", tiff_file([(page(32, form=3), [FLOATS[:48]])]))
    put("tiff", "rgb", tiff_file([(page(samples=3), [bytes(range(36))])]))
    put("tiff", "rgba", tiff_file([(page(samples=4, more=[(338, 3, [2])]), [bytes(range(48))])]))
    put("tiff", "planar", tiff_file([(page(samples=3, more=[(284, 3, [2])]),
                                      [plane, plane, plane])]))
    put("tiff", "deflate", tiff_file([(page(compression=8, more=[(317, 3, [2])]),
                                       [zlib.compress(plane)])]))
    put("tiff", "packbits", tiff_file([(page(compression=32773), [packbits(plane)])]))
    put("tiff", "lzw", tiff_file([(page(compression=5), [b"\x80\0\1\2\3\4\5\6\7\x80\x80"])]))
    put("tiff", "strips", tiff_file([(page(more=[(278, 3, [1])]),
                                      [plane[:4], plane[4:8], plane[8:]])]))
    put("tiff", "tiles", tiff_file([(page(width=20, height=17,
                                          more=[(322, 3, [16]), (323, 3, [16])]),
                                     [bytes(256)] * 4)]))
    put("tiff", "bilevel", tiff_file([(page(1, width=8), [b"abc"])]))
    put("tiff", "palette", tiff_file([(page(4, photometric=3,
                                            more=[(320, 3, list(range(0, 48 * 99, 99)))]),
                                       [b"abcdef"])]))
    put("tiff", "bigtiff", tiff_file([(page(), [plane])], big=True))
    put("tiff", "resolution", tiff_file([(page(more=[(282, 5, [100, 1]), (283, 5, [50, 1]),
                                                     (296, 3, [3])]), [plane])]))
    imagej = b"ImageJ=1.53\nimages=2\nslices=2\nunit=micron\nspacing=2.5\nhyperstack=true\n\0"
    put("tiff", "imagej", tiff_file([(page(more=[(270, 2, imagej)]), [plane]), (page(), [plane])]))
    ome = (b'<?xml version="1.0"?><OME xmlns="http://www.openmicroscopy.org/Schemas/OME/2016-06">'
           b'<Image ID="Image:0"><Pixels ID="Pixels:0" DimensionOrder="XYCZT" Type="uint8" '
           b'SizeX="4" SizeY="3" SizeC="2" SizeZ="2" SizeT="1" PhysicalSizeX="0.5" '
           b'PhysicalSizeY="0.5" PhysicalSizeZ="2" PhysicalSizeZUnit="mm">'
           b'<TiffData IFD="0" FirstZ="0" FirstC="0" PlaneCount="4"/></Pixels></Image></OME>\0')
    put("tiff", "ome", tiff_file([(page(more=[(270, 2, ome)]), [plane])] + [(page(), [plane])] * 3))


class Bits:
    def __init__(self):
        self.text = ""

    def add(self, value, count):
        self.text += format(value, f"0{count}b") if count else ""

    def bytes(self):
        text = self.text + "0" * (-len(self.text) % 32)
        return bytes(int(text[i:i + 8], 2) for i in range(0, len(text), 8))


def dds(data, skip=1, strip=1, magic=b"DDS v3d\n"):
    bits = Bits()
    bits.add(skip - 1, 2)
    bits.add(strip - 1, 16)
    order = b"".join(data[plane::skip] for plane in range(skip))
    last = 0
    for i in range(0, len(order), 100):
        part = order[i:i + 100]
        bits.add(len(part), 7)
        bits.add(7, 3)  # eight bits wide
        for byte in part:
            bits.add((byte - last + 128) % 256, 8)
            last = byte
    bits.add(0, 7)
    return magic + bits.bytes()


def pvm():
    one = b"PVM\n2 3 4\n1\n" + BYTES
    two = b"PVM2\n2 3 4\n1 1.5 2\n2\n" + SHORTS
    three = b"PVM3\n2 3 4\n1 1 1\n1\n" + BYTES + b"what\0who\0how\0why\0"
    put("pvm", "one", one)
    put("pvm", "comment", one.replace(b"PVM\n", b"PVM\n# by hand\n"))
    put("pvm", "two", two)
    put("pvm", "three", three)
    put("pvm", "dds", dds(three))
    put("pvm", "dds_skip", dds(two, skip=2))
    put("pvm", "dds_block", dds(two, skip=2, magic=b"DDS v3e\n"))


def transfer():
    def seed(name, value):
        put("transfer", name, json.dumps(value))

    seed("points", {"points": [[0, 0, 0, 0, 0], [0.5, "#ff8000", 0.2], [1, 1, 1, 1, 1]],
                    "scale": "relative", "opacity_unit": 2, "interpolation": "nearest",
                    "entries": 256})
    seed("curves", {"colours": [[-100, 0, 0, 0], [300, 1, 0.5, 0.25], [300, 1, 1, 1]],
                    "opacities": [[-100, 0], [0, 0.5], [300, 1]], "scale": "absolute"})
    seed("preset", {"preset": "hot", "range": [10, 90], "scale": "percentile"})
    seed("paraview", [{"ColorSpace": "RGB", "Name": "seed", "NanColor": [1, 0, 0],
                       "Points": [0, 0, 0.5, 0, 1, 1, 0.5, 0],
                       "RGBPoints": [0, 0, 0, 0, 0.5, 1, 0, 0, 1, 1, 1, 1]}])
    seed("paraview_lab", [{"ColorSpace": "Diverging", "Creator": "seed",
                           "RGBPoints": [-1, 0.2, 0.3, 0.7, 1, 0.7, 0, 0.1]}])


def recipe():
    def seed(name, value, **more):
        put("recipe", name, json.dumps({"value": value, **more}))
    seed("number", 0.5)
    seed("names", ["+", "x", "y", "z", "radius", "time", "object", "object_value"])
    seed("arithmetic", ["/", ["-", ["*", "x", 2, 3], ["-", "y"]], ["min", 1, ["max", "x", "y"]]])
    seed("functions", ["+"] + [[name, "x"] for name in ("abs", "sin", "cos", "sqrt", "exp", "floor", "fract")] +
         [[name, 0.3, "x"] for name in ("pow", "bias", "gain")] +
         [[name, "x", "y", "z"] for name in ("clamp", "smoothstep", "mix")])
    seed("objects", ["max", ["sphere", 0.5, 0.1], ["box", 0.5, 0.4, 0.3, 0.1], ["torus", 0.7, 0.2, 0.1]])
    seed("noises", ["+", ["noise", 2], ["noise-1985", 3], ["fbm", 2, 4], ["turbulence", 2, 12], ["ridged", "x", 1],
                    ["worley", 4, 4]])
    seed("places", ["at", [["+", "x", 1], 2, "z"], ["at", ["y", "x", 0], ["sphere", 1, 1]]])
    seed("definitions", ["+", "a", "b"], define={"a": ["noise", 2], "b": ["*", "a", "a"]}, comment="two")


def transform():
    put("transform", "euler", "#Insight Transform File V1.0\n#Transform 0\n"
        "Transform: Euler3DTransform_double_3_3\nParameters: 0.1 -0.2 0.3 4 5 6\n"
        "FixedParameters: 1 2 3\n")
    put("transform", "euler_zyx", "#Insight Transform File V1.0\n"
        "Transform: Euler3DTransform_double_3_3\nParameters: 0.1 -0.2 0.3 4 5 6\n"
        "FixedParameters: 1 2 3 1\n")
    put("transform", "versor", "#Insight Transform File V1.0\n"
        "Transform: VersorRigid3DTransform_double_3_3\nParameters: 0 0 0.6 4 5 6\n"
        "FixedParameters: 1 2 3\n")
    put("transform", "affine", "#Insight Transform File V1.0\n"
        "Transform: AffineTransform_double_3_3\nParameters: 0 1 0 -1 0 0 0 0 1 4 5 6\n"
        "FixedParameters: 0 0 0\n")
    put("transform", "matrix", "0 -1 0 5\n1 0 0 6\n0 0 1 7\n0 0 0 1\n")
    put("transform", "commas", "# by hand\n0, -1, 0, 5,\n1, 0, 0, 6,\n0, 0, 1, 7\n0 0 0 1.0e0")


def scene():
    def seed(name, value):
        put("scene", name, json.dumps(value, indent=1))

    generated = {"generate": {"kind": "sphere", "size": 4}}
    file = {"file": "voxels.raw", "raw": {"dims": [2, 3, 4], "type": "uint8"}}
    seed("least", {"volumes": [file]})
    seed("generated", {"volumes": [generated, {"generate": {"kind": "head-pair", "second": True,
                                                             "size": 6, "type": "uint16"}}]})
    seed("settings", {
        "$schema": "scene.schema.json", "comment": "all of it", "background": "#ff800080",
        "camera": {"eye": [0, -90, 5], "target": [0, 0, 0], "up": [0, 0, 1], "fov": 30},
        "render": {"size": [320, 200], "mixing": "over", "step": 0.25, "phase": 0,
                   "termination": 1, "origin": "bounds"},
        "output": {"file": "out/p.png", "depth": 16, "alpha": "premultiplied"}, "volumes": [file]})
    seed("camera", {"camera": {"view": "left", "fit": "b", "orthographic": True},
                    "volumes": [dict(file, name="a"), dict(file, name="b", visible=False,
                                                           transform={"translate": [4, 5, 6]})]})
    seed("poses", {"volumes": [
        dict(file, transform=[[0, -1, 0, 5], [1, 0, 0, 6], [0, 0, 1, 7], [0, 0, 0, 1]]),
        dict(file, transform={"quaternion": [0, 0, 1, 1], "translation": [1, 2, 3]}),
        dict(file, transform={"rotate": {"axis": [0, 0, 2], "degrees": 90, "about": "centre"}}),
        dict(file, transform="nowhere.tfm")]})
    seed("transfers", {"volumes": [
        dict(file, name="ct", density=0.5, extent="point", filter="nearest", opacity_unit=3,
             transfer="hot", spacing=[2, 3, 4]),
        dict(file, transfer={"points": [[0, "#000000", 0], [1, "#ffffff", 0.5]],
                             "scale": "relative"}),
        dict(file, transfer="nowhere.json")]})


for make in (nrrd, nifti, metaimage, raw, tiff, pvm, transfer, recipe, transform, scene):
    make()
