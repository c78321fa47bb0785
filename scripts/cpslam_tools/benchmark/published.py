"""The paper's result tables, as printed. A value is "RMSE/mean", "RMSE" alone, or "-" where the paper has none.

ATE in metres. RPE as (translation in metres, rotation in degrees).
"""

import collections

from ..datasets import BONN_PAPER, TUM_PAPER

# sequences: folder names; ate: {folder: {method: value}}; rpe: {folder: {method: (value, value)}}.
Section = collections.namedtuple("Section", "title sequences ate rpe")

TUM_METHODS = ("ORB-SLAM2", "DS-SLAM", "DynaSLAM", "Crowd-SLAM", "Liu et al.", "RDS-SLAM", "SOLO-SLAM", "CP-SLAM paper")
TUM_ATE = (
    ("0.008/0.007", "0.006/0.006", "0.006/0.005", "0.008/0.007", "0.006/0.005", "-", "-", "0.007/0.006"),
    ("0.009/0.008", "-", "0.014/0.013", "0.018/0.017", "-", "-", "-", "0.014/0.013"),
    ("0.018/0.014", "-", "0.046/0.026", "0.015/0.013", "-", "-", "-", "0.013/0.012"),
    ("0.021/0.017", "-", "0.022/0.018", "0.020/0.017", "-", "-", "-", "0.017/0.015"),
    ("0.377/0.341", "0.008/0.007", "0.007/0.006", "0.007/0.007", "0.010/0.007", "0.0206", "0.0104", "0.006/0.005"),
    ("0.739/0.624", "0.024/0.019", "0.015/0.013", "0.020/0.017", "0.016/0.014", "0.0571", "0.0187", "0.018/0.015"),
    ("0.469/0.423", "0.444/0.377", "-", "0.044/0.031", "0.042/0.030", "0.1604", "0.1194", "0.030/0.024"),
    ("0.442/0.358", "0.030/0.026", "0.030/0.026", "0.026/0.022", "0.031/0.026", "0.0807", "0.0276", "0.028/0.025"),
)
BONN_METHODS = ("ORB-SLAM2", "CP-SLAM paper")
BONN_ATE = (("0.914", "0.026"), ("1.453", "0.037"), ("1.140", "0.033"), ("1.098", "0.009"), ("1.484", "0.008"))

# Both tables: ORB-SLAM2, then CP-SLAM.
RPE_METHODS = ("ORB-SLAM2", "CP-SLAM paper")
TUM_RPE = (
    (("0.012/0.011", "0.348/0.314"), ("0.010/0.009", "0.317/0.283")),
    (("0.014/0.012", "0.585/0.497"), ("0.021/0.019", "0.592/0.514")),
    (("0.027/0.023", "0.847/0.747"), ("0.023/0.020", "0.618/0.553")),
    # CP-SLAM's numbers are printed like this: those of sitting_static once more.
    (("0.031/0.025", "0.769/0.697"), ("0.010/0.009", "0.317/0.283")),
    (("0.540/0.366", "9.868/6.721"), ("0.009/0.006", "0.264/0.238")),
    (("1.116/0.908", "7.302/5.652"), ("0.026/0.023", "0.668/0.530")),
    (("0.687/0.588", "11.778/9.711"), ("0.059/0.049", "1.393/1.185")),
    (("0.649/0.505", "15.483/12.684"), ("0.041/0.036", "0.959/0.855")),
)
BONN_RPE = (
    (("1.324", "39.463"), ("0.317", "21.040")),
    (("2.105", "85.735"), ("0.218", "25.315")),
    (("1.695", "42.485"), ("0.232", "23.916")),
    (("1.551", "27.880"), ("0.028", "1.272")),
    (("2.139", "38.688"), ("0.008", "9.289")),
)


def _section(title, sequences, ate_methods, ate, rpe):
    return Section(title, sequences, {name: dict(zip(ate_methods, row, strict=True))
                                      for name, row in zip(sequences, ate, strict=True)},
                   {name: dict(zip(RPE_METHODS, row, strict=True)) for name, row in zip(sequences, rpe, strict=True)})


SECTIONS = (
    _section("TUM RGB-D, freiburg3", TUM_PAPER, TUM_METHODS, TUM_ATE, TUM_RPE),
    _section("Bonn RGB-D Dynamic", BONN_PAPER, BONN_METHODS, BONN_ATE, BONN_RPE),
)


def rmse(value):
    """The first number of a value, None for "-"."""
    return None if value == "-" else float(value.split("/")[0])
