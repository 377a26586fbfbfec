# Opens the series in ParaView: `paraview --script=FILE`, or Tools > Python Shell > Run Script.
import os
from paraview.simple import *

try:
    folder = os.path.dirname(os.path.abspath(__file__))
except NameError:  # started from the Python shell
    folder = os.getcwd()

def opened(series, where, field, opacity):
    data = PVDReader(registrationName=series, FileName=os.path.join(folder, series))
    shown = Show(data)
    shown.Representation = 'Surface With Edges'
    shown.Opacity = opacity
    try:
        ColorBy(shown, (where, field))
        shown.RescaleTransferFunctionToDataRange(True)
        shown.SetScalarBarVisibility(GetActiveView(), True)
    except RuntimeError:  # no data yet
        pass
    return data

stem = 'lined'
opened(stem + '.pvd', 'POINTS', 'displacement', 0.5)
opened(stem + '_joints.pvd', 'CELLS', 'shear_displacement', 1.0)
view = GetActiveView()
view.OrientationAxesVisibility = 1
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
GetAnimationScene().GoToLast()
ResetCamera()
Render()
