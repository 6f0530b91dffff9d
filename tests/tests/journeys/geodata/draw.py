"""Edits the layer `drawn` of a site by the C interface of GDAL, as QGIS does: `draw.py DATABASE EDIT…`, each a JSON object with
`wkt` (a shape that is added, or that takes the place of `was`), or `gone` (the name of one that is deleted). Prints of each what
GDAL says is wrong, or an empty line."""
import ctypes
import glob
import json
import os
import sys
import warnings

import pyogrio

warnings.simplefilter("ignore")
libraries = os.path.join(os.path.dirname(pyogrio.__file__), "..", "pyogrio.libs")
gdal = ctypes.CDLL(glob.glob(os.path.join(libraries, "libgdal*"))[0])
pointer, text, number = ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int
for name, result, takes in [
    ("GDALAllRegister", None, []),
    ("GDALOpenEx", pointer, [text, ctypes.c_uint, pointer, pointer, pointer]),
    ("GDALClose", number, [pointer]),
    ("GDALDatasetGetLayerByName", pointer, [pointer, text]),
    ("OGR_L_GetLayerDefn", pointer, [pointer]),
    ("OGR_L_SetAttributeFilter", number, [pointer, text]),
    ("OGR_L_ResetReading", None, [pointer]),
    ("OGR_L_GetNextFeature", pointer, [pointer]),
    ("OGR_L_CreateFeature", number, [pointer, pointer]),
    ("OGR_L_SetFeature", number, [pointer, pointer]),
    ("OGR_L_DeleteFeature", number, [pointer, ctypes.c_longlong]),
    ("OGR_F_Create", pointer, [pointer]),
    ("OGR_F_GetFID", ctypes.c_longlong, [pointer]),
    ("OGR_F_GetFieldIndex", number, [pointer, text]),
    ("OGR_F_SetFieldString", None, [pointer, number, text]),
    ("OGR_F_SetGeometryDirectly", number, [pointer, pointer]),
    ("OGR_G_CreateFromWkt", number, [ctypes.POINTER(text), pointer, ctypes.POINTER(pointer)]),
    ("CPLGetLastErrorMsg", text, []),
    ("CPLErrorReset", None, []),
]:
    function = getattr(gdal, name)
    function.restype, function.argtypes = result, takes

OPEN_FOR_UPDATE, VECTOR = 0x01, 0x04
gdal.GDALAllRegister()
data = gdal.GDALOpenEx(f"GPKG:{sys.argv[1]}".encode(), OPEN_FOR_UPDATE | VECTOR, None, None, None)
layer = gdal.GDALDatasetGetLayerByName(data, b"drawn")


def named(name):
    gdal.OGR_L_SetAttributeFilter(layer, f"name = '{name}'".encode())
    gdal.OGR_L_ResetReading(layer)
    found = gdal.OGR_L_GetNextFeature(layer)
    assert found, f"no shape is called {name}"
    return found


for edit in map(json.loads, sys.argv[2:]):
    gdal.CPLErrorReset()
    if "gone" in edit:
        failed = gdal.OGR_L_DeleteFeature(layer, gdal.OGR_F_GetFID(named(edit["gone"])))
    else:
        feature = named(edit["was"]) if "was" in edit else gdal.OGR_F_Create(gdal.OGR_L_GetLayerDefn(layer))
        wkt, shape = text(edit["wkt"].encode()), pointer()
        gdal.OGR_G_CreateFromWkt(ctypes.byref(wkt), None, ctypes.byref(shape))
        gdal.OGR_F_SetGeometryDirectly(feature, shape)
        for field, value in edit.get("fields", {}).items():
            gdal.OGR_F_SetFieldString(feature, gdal.OGR_F_GetFieldIndex(feature, field.encode()), value.encode())
        failed = (gdal.OGR_L_SetFeature if "was" in edit else gdal.OGR_L_CreateFeature)(layer, feature)
    print(gdal.CPLGetLastErrorMsg().decode().replace("\n", " ") if failed else "")
gdal.GDALClose(data)
