"""MuJoCo's C library with the attributes that its Python binding has, for tests: the binding is in no Debian package.

    view = Mujoco("mujoco_facts", "model.xml")    # the program that knows where the fields are
    view.step()
    record_mujoco(recorder, view.model, view.data)
"""

import ctypes
import ctypes.util
import subprocess
from ctypes import c_char, c_double, c_float, c_int, c_void_p
from types import SimpleNamespace

# By field: its type, how many (a field of the model, or a number; None: one value), and how many numbers each has.
MODEL = {
    "nbody": (c_int, None, 1), "ngeom": (c_int, None, 1), "nmesh": (c_int, None, 1), "nmeshvert": (c_int, None, 1),
    "nmeshgraph": (c_int, None, 1), "nhfield": (c_int, None, 1), "nhfielddata": (c_int, None, 1),
    "npair": (c_int, None, 1), "nnames": (c_int, None, 1),
    "opt.timestep": (c_double, None, 1), "opt.gravity": (c_double, None, 3), "opt.cone": (c_int, None, 1),
    "opt.iterations": (c_int, None, 1), "opt.disableflags": (c_int, None, 1),
    "body_rootid": (c_int, "nbody", 1), "body_weldid": (c_int, "nbody", 1), "body_mass": (c_double, "nbody", 1),
    "geom_type": (c_int, "ngeom", 1), "geom_contype": (c_int, "ngeom", 1), "geom_conaffinity": (c_int, "ngeom", 1),
    "geom_bodyid": (c_int, "ngeom", 1), "geom_dataid": (c_int, "ngeom", 1), "geom_size": (c_double, "ngeom", 3),
    "mesh_vertadr": (c_int, "nmesh", 1), "mesh_vertnum": (c_int, "nmesh", 1), "mesh_graphadr": (c_int, "nmesh", 1),
    "mesh_vert": (c_float, "nmeshvert", 3), "mesh_graph": (c_int, "nmeshgraph", 1),
    "hfield_size": (c_double, "nhfield", 4), "hfield_nrow": (c_int, "nhfield", 1), "hfield_ncol": (c_int, "nhfield", 1),
    "hfield_adr": (c_int, "nhfield", 1), "hfield_data": (c_float, "nhfielddata", 1),
    "pair_geom1": (c_int, "npair", 1), "pair_geom2": (c_int, "npair", 1),
    "name_bodyadr": (c_int, "nbody", 1), "name_geomadr": (c_int, "ngeom", 1), "names": (c_char, "nnames", 1),
}
DATA = {
    "nefc": (c_int, None, 1), "ncon": (c_int, None, 1), "time": (c_double, None, 1), "xipos": (c_double, "nbody", 3),
    "geom_xpos": (c_double, "ngeom", 3), "geom_xmat": (c_double, "ngeom", 9), "subtree_com": (c_double, "nbody", 3),
    "cvel": (c_double, "nbody", 6), "efc_force": (c_double, "nefc", 1),
}
CONTACT = {
    "dist": (c_double, None, 1), "pos": (c_double, None, 3), "frame": (c_double, None, 9),
    "friction": (c_double, None, 5), "dim": (c_int, None, 1), "geom1": (c_int, None, 1), "geom2": (c_int, None, 1),
    "efc_address": (c_int, None, 1),
}


try:
    from numpy import array  # as the binding returns arrays
except ImportError:
    array = list


def library():
    """MuJoCo's library, or None where it is not installed."""
    name = ctypes.util.find_library("mujoco")
    return ctypes.CDLL(name) if name else None


def _read(address, kind, count, width):
    """A number or an array."""
    if count is None:
        values = (kind * width).from_address(address)
        return values[0] if width == 1 else array(values[:])
    start = c_void_p.from_address(address).value
    if kind is c_char:
        return ctypes.string_at(start, count)
    if count == 0:
        return array([])
    values = (kind * (count * width)).from_address(start)[:]
    return array(values if width == 1 else [values[i:i + width] for i in range(0, len(values), width)])


class _Struct:
    """Fields are read when they are used, as those of the binding are."""

    def __init__(self, address, offsets, fields, sizes):
        self._address, self._offsets, self._fields, self._sizes = address, offsets, fields, sizes

    def __getattr__(self, name):
        if name not in self._fields:
            raise AttributeError(name)
        kind, size, width = self._fields[name]
        count = None if size is None else getattr(self if size in self._fields else self._sizes, size)
        return _read(self._address + self._offsets[name], kind, count, width)


class Mujoco:
    def __init__(self, facts, file):
        offsets = {"mjModel": {}, "mjData": {}, "mjContact": {}}
        for line in subprocess.run([facts], stdout=subprocess.PIPE, check=True, encoding="utf-8").stdout.splitlines():
            struct, field, offset = line.split()
            offsets[struct][field] = int(offset)
        self._lib = library()
        for name in ("mj_loadXML", "mj_makeData"):
            getattr(self._lib, name).restype = c_void_p
        for name in ("mj_makeData", "mj_deleteData", "mj_deleteModel"):
            getattr(self._lib, name).argtypes = [c_void_p]
        for name in ("mj_step", "mj_forward"):
            getattr(self._lib, name).argtypes = [c_void_p, c_void_p]
        error = ctypes.create_string_buffer(512)
        self._model = self._lib.mj_loadXML(str(file).encode(), None, error, 512)
        if not self._model:
            raise ValueError(error.value.decode())
        self._data = self._lib.mj_makeData(self._model)
        self.model = _Struct(self._model, offsets["mjModel"], MODEL, None)
        self.model.opt = SimpleNamespace(**{name[len("opt."):]: getattr(self.model, name)
                                            for name in MODEL if name.startswith("opt.")})
        self.data = _Struct(self._data, offsets["mjData"], DATA, self.model)
        self.data.contact = _Contacts(self._data + offsets["mjData"]["contact"], offsets["mjContact"])

    def step(self):
        self._lib.mj_step(self._model, self._data)

    def forward(self):
        self._lib.mj_forward(self._model, self._data)

    def close(self):
        self._lib.mj_deleteData(self._data)
        self._lib.mj_deleteModel(self._model)


class _Contacts:
    def __init__(self, address, offsets):
        self._address, self._offsets = address, offsets

    def __getitem__(self, i):
        start = c_void_p.from_address(self._address).value
        return _Struct(start + i * self._offsets["size"], self._offsets, CONTACT, None)


def version():
    lib = library()
    lib.mj_versionString.restype = ctypes.c_char_p
    return lib.mj_versionString().decode()
