"""billet: metal forming by implicit finite elements, in Python.

    import billet

    case = billet.Case.load("case.toml")
    case["tool.punch.friction.m"] = 0.2
    for inc in billet.Run(case):
        print(inc.time, inc.forces["punch"])

Units are those of the case: mm, N, s and MPa unless it says otherwise.

Case, Run, State, Increment       a case and its run in memory
Field                            an array that knows its unit
simulate, study, chart, identify the program billet, which writes results to folders
results, Results, Frame          what it has written
Error                            what cannot be run, read or found, and why
"""

from ._case import Case, CaseReport, ListView, TableView
from ._errors import Error, MissingKey, MissingPackage, NotConverged, ProgramError
from ._identification import FittedLaw, Identification, Parameter, identify
from ._program import program, simulate
from ._results import Frame, FrameData, Results, results
from ._run import Increment, Run, State
from ._studies import Chart, ChartedQuantity, Study, chart, study
from ._table import Table
from ._native import __version__
from ._values import Field

__all__ = [
    "Case",
    "CaseReport",
    "Chart",
    "ChartedQuantity",
    "Error",
    "Field",
    "FittedLaw",
    "Frame",
    "FrameData",
    "Identification",
    "Increment",
    "ListView",
    "MissingKey",
    "MissingPackage",
    "NotConverged",
    "Parameter",
    "ProgramError",
    "Results",
    "Run",
    "State",
    "Study",
    "Table",
    "TableView",
    "chart",
    "identify",
    "program",
    "results",
    "simulate",
    "study",
]
