"""Reads frames of a run, with nothing but Python's standard library: points, fields, faces."""

import base64
import struct
import xml.etree.ElementTree as xml
import zlib


FORMATS = {"Float64": ("d", 8), "Int32": ("i", 4)}


def array(root, element):
    """Numbers of a VTK XML DataArray in base64: headers of UInt64, then the bytes as they are or, where
    the file names a compressor, blocks of zlib."""
    text = "".join(element.text.split())
    data = unpacked(text) if root.get("compressor") else base64.b64decode(text)[8:]
    letter, size = FORMATS[element.get("type")]
    return struct.unpack(f"<{len(data) // size}{letter}", data)


def unpacked(text):
    blocks = struct.unpack("<Q", base64.b64decode(text[:12])[:8])[0]
    head_bytes = 8 * (3 + blocks)
    head_text = -(-head_bytes // 3) * 4
    sizes = struct.unpack(f"<{3 + blocks}Q", base64.b64decode(text[:head_text])[:head_bytes])[3:]
    packed, data, at = base64.b64decode(text[head_text:]), b"", 0
    for size in sizes:
        data += zlib.decompress(packed[at:at + size])
        at += size
    return data


def frames(results):
    """(time, path) of each frame of the workpiece."""
    for item in xml.parse(next(results.glob("*.pvd"))).getroot().iter("DataSet"):
        if item.get("name") == "workpiece":
            yield float(item.get("timestep")), results / item.get("file")


def nodes(path):
    """Points, displacements and velocities of a frame of the workpiece."""
    root = xml.parse(path).getroot()
    arrays = [root.find(".//Points/DataArray")] + [root.find(f".//PointData/DataArray[@Name='{name}']")
                                                   for name in ("displacement", "velocity")]
    flat = [array(root, each) for each in arrays]
    return [list(zip(v[0::3], v[1::3], v[2::3])) for v in flat]


def surface(path):
    """Points of the contact faces and the pairs of nodes that are next to each other on one."""
    root = xml.parse(path).getroot()
    flat = array(root, root.find(".//Points/DataArray"))
    points = list(zip(flat[0::3], flat[1::3], flat[2::3]))
    edges = set()
    for kind, closed in (("Lines", False), ("Polys", True)):
        arrays = {e.get("Name"): e for e in root.find(f".//{kind}")}
        nodes, start = array(root, arrays["connectivity"]), 0
        for end in array(root, arrays["offsets"]):
            face = nodes[start:end] + (nodes[start:start + 1] if closed else ())
            edges.update(zip(face, face[1:]))
            start = end
    return points, edges
