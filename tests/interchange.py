#!/usr/bin/env python3
"""Exchanges spectral OpenEXR files between Pellicle, colour-science (which reads with OpenImageIO) and the OpenEXR library.

    python3 -m venv venv && venv/bin/pip install colour-science scipy OpenImageIO OpenEXR
    cargo build --release && venv/bin/python tests/interchange.py target/release/pellicle

Checks that colour-science reads the bands of Pellicle's files, that the OpenEXR library reads R, G, B and the same numbers, and that
Pellicle reads the same numbers from files of colour-science. Fails if any of these does not hold.
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import warnings

warnings.filterwarnings("ignore")

import colour
import numpy as np
import OpenEXR
from colour.io import (
    Specification_Fichet2021,
    read_spectral_image_Fichet2021,
    write_spectral_image_Fichet2021,
)

PELLICLE = pathlib.Path(sys.argv[1]).resolve()
SCENE = pathlib.Path(__file__).resolve().parent.parent / "scenes" / "soap_bubble.toml"


def pellicle(*arguments):
    command = [str(PELLICLE), *map(str, arguments)]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def inspect(path, *places):
    at = [word for x, y in places for word in ("--at", f"{x},{y}")]
    return json.loads(pellicle("inspect", path, "--format", "json", *at))


def check(what, is_so):
    print(f"{'ok  ' if is_so else 'FAIL'} {what}")
    if not is_so:
        sys.exit(1)


def written_here(folder):
    path = folder / "bubble.exr"
    pellicle("render", SCENE, "--backend", "cpu", "--size", "48x36", "--samples", "8", "-o", path)
    components, specification = read_spectral_image_Fichet2021(path, additional_data=True)
    wavelengths, radiance = components["S0"]
    check("colour-science: emissive, not polarized, not bispectral",
          (specification.is_emissive, specification.is_polarised, specification.is_bispectral) == (True, False, False))
    check("colour-science: 40 bands from 385 to 775 nm", np.array_equal(np.sort(wavelengths), np.arange(385, 776, 10)))
    channels = OpenEXR.File(str(path), separate_channels=True).channels()
    pixels = {name: channel.pixels for name, channel in channels.items()}
    same = [np.array_equal(pixels[f"S0.{nm:.0f},000000nm"], radiance[..., i].astype(np.float32))
            for i, nm in enumerate(wavelengths)]
    check("colour-science and the OpenEXR library read the same radiances", all(same))
    at = inspect(path, (24, 14))["places"][0]
    check("and Pellicle too", np.allclose(at["radiance"], radiance[14, 24][np.argsort(wavelengths)], rtol=1e-6))
    # Y from the bands by colour-science's observer, summed at the centers of the bands, against Y summed at the sampled wavelengths.
    observer = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
    y_bar = np.array([observer[nm][1] for nm in wavelengths])
    luminance = 683 * 10 * (radiance * y_bar).sum(-1).mean()
    check("Y of the bands equals Y of the file within 1 %", abs(luminance / pixels["pellicle.cieY"].mean() - 1) < 0.01)
    rgb = np.stack([pixels[name] for name in "RGB"], -1)
    check("an ordinary reader finds R, G, B that are not black", np.isfinite(rgb).all() and rgb.max() > 0.5)


def written_there(folder):
    path = folder / "d65.exr"
    d65 = colour.SDS_ILLUMINANTS["D65"]
    write_spectral_image_Fichet2021(d65, path, "float32", Specification_Fichet2021(is_emissive=True))
    found = inspect(path, (0, 0))
    radiance = found["places"][0]["radiance"]
    check("D65 of colour-science: the same numbers, but only beyond 360 nm",
          np.allclose(radiance, [d65[nm] for nm in found["centers_nm"]], rtol=1e-6) and len(radiance) == 84)
    check("its chromaticity is 0.3127, 0.3290", np.allclose(found["places"][0]["xy"], [0.31272, 0.32903], atol=5e-5))
    path = folder / "chart.exr"
    patches = list(colour.SDS_COLOURCHECKERS["ISO 17321-1"].values())
    shape = (4, 6, len(patches[0].wavelengths))
    write_spectral_image_Fichet2021(patches, path, "float16", Specification_Fichet2021(), shape=shape)
    found = inspect(path, (0, 0), (5, 3))
    for place, patch in zip(found["places"], (patches[0], patches[23])):
        expected = [patch[nm] for nm in found["centers_nm"]]
        check(f"reflectances in half floats: {patch.name}", np.allclose(place["radiance"], expected, rtol=1e-3))


with tempfile.TemporaryDirectory() as folder:
    written_here(pathlib.Path(folder))
    written_there(pathlib.Path(folder))
