"""Values for the cases of header fields, and published matrices.

AP1 and AP0 to Rec. 709 by Bradford are those of the ACES documentation, Rec. 2020 that of ITU-R BT.2087-0, P3
that of SMPTE EG 432-1 by way of its XYZ, CIE XYZ that of IEC 61966-2-1.
"""

import numpy as np

from burnish import images

AP1 = (0.713, 0.293, 0.165, 0.83, 0.128, 0.044, 0.32168, 0.33767)
REC_2020 = (0.708, 0.292, 0.17, 0.797, 0.131, 0.046, 0.3127, 0.3290)
FROM_AP1 = np.array(
    [[1.70505, -0.62179, -0.08326], [-0.13026, 1.14080, -0.01055], [-0.02400, -0.12897, 1.15297]]
)
FROM_AP0 = np.array(
    [[2.52169, -1.13413, -0.38756], [-0.27648, 1.37272, -0.09624], [-0.01538, -0.15298, 1.16835]]
)
FROM_2020 = np.array([[1.6605, -0.5876, -0.0728], [-0.1246, 1.1329, -0.0083], [-0.0182, -0.1006, 1.1187]])
FROM_P3 = np.array([[1.2249, -0.2247, 0.0], [-0.0420, 1.0419, 0.0], [-0.0197, -0.0786, 1.0979]])
FROM_XYZ = np.array(
    [
        [3.2404542, -1.5371385, -0.4985314],
        [-0.9692660, 1.8760108, 0.0415560],
        [0.0556434, -0.2040259, 1.0572252],
    ]
)

# Numbers that eight bits and a common exponent hold.
RGB = np.random.default_rng(7).integers(128, 256, (4, 8, 3)).astype(np.float32) / 256
SAMPLES = np.random.default_rng(8).integers(0, 256, (4, 8, 3), np.uint8)
LINEAR = images.srgb_decode(SAMPLES / 255.0)
PROPER = {name: RGB[..., i] for i, name in enumerate("RGB")}
