#!/usr/bin/env bash
# Compares three descriptions of scene files: the key tables of the parser, scenes/scene.schema.json and
# scenes/README.md must have the same keys, every scene and every example must follow the schema, and the schema must
# refuse what the parser refuses.
set -eu
cd "${SOURCE:-$(dirname "$0")/../..}"
python3 -c 'import jsonschema' 2>/dev/null || { echo "skipped: python3-jsonschema is not installed"; exit 77; }
exec python3 - <<'EOF'
import copy, glob, json, re, sys, warnings
warnings.simplefilter("ignore")
import jsonschema

failures = []
def check(good, *what):
    if not good:
        failures.append(" ".join(str(w) for w in what))

schema = json.load(open("scenes/scene.schema.json"))
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)
defs = schema["$defs"]

# Keys of the parser: tables named X_keys; names it accepts: tables named X_names.
tables = {}
for path in sorted(glob.glob("host/world/scene_*.c") + glob.glob("host/transfer/*.c") +
                   glob.glob("host/volume/generate.c") + glob.glob("host/camera/stereo.c") +
                   glob.glob("host/world/mixing.c")):
    for name, body in re.findall(r"const char \*const (\w+)\[\] = \{([^}]*)\}", open(path).read()):
        tables[path.split("/")[-1] + ":" + name] = re.findall(r'"([^"]+)"', body)

# The object of the schema, or its alternatives, that goes with each table.
matrix, quaternion, rotate, file = defs["transform"]["anyOf"]
own_transfer = next(a for a in defs["transfer"]["anyOf"] if "properties" in a)
rotation = rotate["properties"]["rotate"]
transforms = {"properties": {**quaternion["properties"], **rotate["properties"], **file["properties"]}}
pairs = {
    "scene_file.c:scene_keys": (schema, "Scene"),
    "scene_camera.c:camera_keys": (defs["camera"], "camera"),
    "scene_read_volume.c:volume_keys": (defs["volume"], "volume"),
    "scene_read_source.c:generate_keys": (defs["generate"], "generate"),
    "scene_read_source.c:hypertexture_keys": (defs["hypertexture"], "hypertexture"),
    "scene_read_source.c:raw_keys": (defs["raw"], "raw"),
    "scene_read_pose.c:transform_keys": (transforms, "transform"),
    "scene_read_pose.c:quaternion_keys": (quaternion, None),
    "scene_read_pose.c:rotate_keys": (rotate, None),
    "scene_read_pose.c:file_keys": (file, None),
    "scene_read_pose.c:rotation_keys": (rotation, "rotate"),
    "scene_read_clip.c:clip_keys": (defs["clip"], "clip"),
    "scene_read_mask.c:mask_keys": (defs["mask"], "mask"),
    "scene_read_clip.c:plane_keys": (defs["plane"], "plane"),
    "scene_read_clip.c:box_keys": (defs["box"], "box"),
    "scene_read_light.c:light_keys": (defs["light"], "light"),
    "scene_read_light.c:shading_keys": (defs["shading"]["anyOf"][1], "shading"),
    "scene_read_style.c:silhouette_keys": (defs["silhouette"], "silhouette"),
    "scene_read_model.c:surface_keys": (defs["surface"]["anyOf"][1], "iso"),
    "transfer_file.c:known_keys": (own_transfer, "transfer"),
    "scene_read_settings.c:render_keys": (defs["render"], "render"),
    "scene_read_settings.c:brick_keys": (defs["bricks"], "bricks"),
    "scene_read_settings.c:supersampling_keys": (defs["supersampling"], "supersampling"),
    "scene_read_secondary.c:shadow_keys": (defs["shadows"], "shadows"),
    "scene_read_secondary.c:occlusion_keys": (defs["ambient_occlusion"], "ambient_occlusion"),
    "scene_read_settings.c:output_keys": (defs["output"], "output"),
    "scene_read_wall.c:wall_keys": (defs["wall"], "wall"),
    "scene_read_wall.c:region_keys": (defs["region"], "region"),
    "scene_read_stereo.c:stereo_keys": (defs["stereo"], "stereo"),
    "scene_read_animation.c:animation_keys": (defs["animation"], "animation"),
    "scene_read_animation.c:track_keys": (defs["track"], "track"),
    "scene_read_animation.c:orbit_keys": (defs["track"]["properties"]["orbit"], "orbit"),
}
readme = open("scenes/README.md").read()
sections = {s.split("\n")[0]: s for s in re.split(r"^## ", readme, flags=re.M)[1:]}
for table in tables:
    check(not table.endswith("_keys") or table in pairs, table, "is compared with nothing")
for table, (described, section) in pairs.items():
    if table not in tables:
        check(False, table, "is not in the source")
        continue
    keys = set(tables[table])
    check(keys == set(described["properties"]), table, "and the schema differ in",
          keys ^ set(described["properties"]))
    if section:
        rows = re.findall(r"^\| `([^`]+)` \|(.*)\|(.*)\|(.*)\|(.*)\|$", sections[section], flags=re.M)
        check(keys == {r[0] for r in rows}, table, "and README.md differ in", keys ^ {r[0] for r in rows})
        for row in rows:
            check(all(cell.strip() for cell in row), "README.md: a cell is empty in", row)

# Every list of names is an enumeration of the schema.
def enumerations(node):
    if isinstance(node, dict):
        if "enum" in node:
            yield frozenset(map(str, node["enum"]))
        for value in node.values():
            yield from enumerations(value)
    elif isinstance(node, list):
        for value in node:
            yield from enumerations(value)
known = set(enumerations(schema))
for table, names in tables.items():
    if re.match(r"scene_.*_names$|preset.c:names$|generate.c:names$|stereo.c:stereo_names$|mixing.c:mixing_names$", table):
        check(frozenset(names) in known, table, "is no enumeration of the schema:", names)

# Scenes and examples follow the schema.
scenes = {path: json.load(open(path)) for path in glob.glob("scenes/*.json") + glob.glob("scenes/thesis/*.json") if not path.endswith("schema.json")}
check(len(scenes) >= 7, "only", len(scenes), "scenes were found")
for number, text in enumerate(re.findall(r"```json\n(.*?)```", readme, flags=re.S)):
    scenes["README.md example %d" % number] = json.loads(text)
for path, scene in scenes.items():
    for error in validator.iter_errors(scene):
        check(False, path, list(error.absolute_path), error.message[:200])

# The examples in the tables do, too.
def place(section, key, value):
    volume = {"file": "a"}
    holder = {"Scene": {}, "camera": {}, "volume": volume, "generate": {"kind": "c60"},
              "hypertexture": {"recipe": "cloud"}, "raw": {"dims": [1, 1, 1]},
              "transform": {}, "rotate": {"axis": "x", "degrees": 1}, "transfer": {"preset": "hot"},
               "render": {}, "stereo": {}, "wall": {}, "region": {"place": [0, 0, 1, 1]}, "output": {}, "light": {}, "shading": {}, "silhouette": {}, "supersampling": {}, "iso": {"value": 1},
               "clip": {}, "plane": {"normal": [0, 0, 1]}, "box": {"size": [1, 1, 1]},
               "bricks": {}, "shadows": {}, "ambient_occlusion": {}, "mask": {"volume": 1, "labels": 1}, "animation": {}, "track": {"key": "camera.fov", "values": [1, 2]}, "orbit": {}}[section]
    if section == "transform":
        holder.update({"translation": {"quaternion": [0, 0, 0, 1]}, "fixed": {"file": "a"},
                       "comment": {"file": "a"}}.get(key, {}))
    if section == "track" and key == "orbit":
        holder.clear()
    if section == "clip" and key not in ("plane", "box"):
        holder["plane"] = {"normal": [0, 0, 1]}
    if section == "light":
        holder["kind"] = {"direction": "directional", "position": "point"}.get(key, "headlight")
    holder[key] = value
    if section == "volume" and key in ("generate", "hypertexture"):
        del volume["file"]
    inner = {section: holder}
    if section == "Scene":
        return {"volumes": [volume], **holder}
    if section in ("generate", "hypertexture"):
        volume = {section: holder}
    elif section in ("supersampling", "bricks", "shadows", "ambient_occlusion"):
        return {"volumes": [volume], "render": {section: holder}}
    elif section == "track":
        return {"volumes": [volume], "animation": {"tracks": [holder]}}
    elif section == "orbit":
        return {"volumes": [volume], "animation": {"tracks": [inner]}}
    elif section == "rotate":
        volume["transform"] = {"rotate": holder}
    elif section == "clip":
        return {"volumes": [{"file": "a", "clip": [holder]}]}
    elif section in ("plane", "box"):
        return {"volumes": [volume], "clip": [inner]}
    elif section == "light":
        return {"volumes": [volume], "lights": [holder]}
    elif section in ("raw", "transform", "transfer", "shading", "silhouette", "iso", "mask"):
        volume[section] = holder
    return {"volumes": [volume], **(inner if section in ("camera", "render", "stereo", "animation", "output") else {})}
for _, section in pairs.values():
    if not section:
        continue
    for key, example in re.findall(r"^\| `([^`]+)` \|.*\| `([^`]+)` \|$", sections[section], flags=re.M):
        scene = place(section, key, json.loads(example))
        for error in validator.iter_errors(scene):
            check(False, "README.md:", section, key, example, error.message[:100])

# The schema is strict.
good = {"volumes": [{"file": "a", "transfer": {"preset": "hot"}, "raw": {"dims": [1, 1, 1]},
                     "transform": {"rotate": {"axis": "x", "degrees": 1}}, "shading": {}},
                    {"generate": {"kind": "box"}}], "camera": {}, "lights": [{}], "render": {}, "stereo": {},
        "animation": {"tracks": [{"orbit": {}}]}, "output": {}}
check(validator.is_valid(good), "a good scene is refused")
for path in ([], ["volumes", 0], ["volumes", 0, "transfer"], ["volumes", 0, "raw"], ["volumes", 0, "transform"],
             ["volumes", 0, "transform", "rotate"], ["volumes", 1, "generate"], ["volumes", 0, "shading"],
             ["lights", 0], ["camera"], ["render"], ["stereo"], ["output"], ["animation"],
             ["animation", "tracks", 0], ["animation", "tracks", 0, "orbit"]):
    bad = copy.deepcopy(good)
    at = bad
    for step in path:
        at = at[step]
    at["unknown"] = 1
    check(not validator.is_valid(bad), "the schema takes an unknown key in", path)
for key, value in (("volumes", []), ("volumes", [{}]), ("volumes", [{"file": "a", "generate": {"kind": "box"}}]),
                   ("volumes", [{"generate": {"kind": "box"}, "time": 1}]), ("background", "pink"),
                   ("lights", []), ("lights", [{}] * 9), ("lights", [{"kind": "point"}]),
                   ("lights", [{"direction": [0, 0, 1]}]), ("camera", {"fov": 180}), ("render", {"step": 0}),
                   ("stereo", {"kind": "3d"}), ("stereo", {"convergence": 0}), ("output", {"depth": 12}),
                   ("animation", {"frames": 0}), ("animation", {"frames": 1, "duration": 1}),
                   ("animation", {"tracks": [{}]}), ("animation", {"tracks": [{"key": "camera.fov"}]})):
    check(not validator.is_valid({**good, key: value}), "the schema takes", key, value)

print("\n".join(failures) or "%d scenes and examples, %d tables of keys and names" % (len(scenes), len(tables)))
sys.exit(1 if failures else 0)
EOF
