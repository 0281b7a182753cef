"""Prints what VTK reads from an image file: dimensions, origin, spacing, time, and every array value by value."""

import sys

try:
    from vtkmodules.vtkIOXML import vtkXMLImageDataReader
except ImportError:
    sys.exit(77)

reader = vtkXMLImageDataReader()
reader.SetFileName(sys.argv[1])
reader.Update()
if reader.GetErrorCode() != 0:
    sys.exit(1)
image = reader.GetOutput()
print("dimensions", *image.GetDimensions())
print("origin", *(repr(x) for x in image.GetOrigin()))
print("spacing", *(repr(x) for x in image.GetSpacing()))
print("time", repr(image.GetFieldData().GetArray("TimeValue").GetValue(0)))
data = image.GetPointData()
for k in range(data.GetNumberOfArrays()):
    array = data.GetArray(k)
    print("array", array.GetName(), array.GetDataTypeAsString(), array.GetNumberOfComponents())
    print(*(repr(array.GetValue(i)) for i in range(array.GetNumberOfValues())))
