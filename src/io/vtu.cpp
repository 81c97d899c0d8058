// SPDX-License-Identifier: GPL-3.0-or-later
#include <libdeflate.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>
#include <vtkZLibDataCompressor.h>

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <memory>
#include <new>
#include <stdexcept>

#include "crackle/io/output.hpp"
#include "file.hpp"

namespace crackle {

namespace {

/// A vtk array over the frame's own memory. VTK only reads while it writes a file; its interface
/// has no const.
template <class Array, class Value>
vtkSmartPointer<Array> borrow(const Value* values, std::size_t count, int components) {
  auto array = vtkSmartPointer<Array>::New();
  array->SetNumberOfComponents(components);
  const int keep = 1;  // do not free
  array->SetArray(const_cast<Value*>(values), static_cast<vtkIdType>(count), keep);
  return array;
}

vtkSmartPointer<vtkPoints> to_points(const std::vector<Vec2>& places) {
  vtkNew<vtkDoubleArray> xyz;
  xyz->SetNumberOfComponents(3);
  xyz->SetNumberOfTuples(static_cast<vtkIdType>(places.size()));
  double* out = xyz->GetPointer(0);
  for (const Vec2 place : places) {
    *out++ = place.x;
    *out++ = place.y;
    *out++ = 0.0;
  }
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(xyz);
  return points;
}

template <std::size_t corners>
vtkSmartPointer<vtkCellArray> to_cells(const std::vector<std::array<Index, corners>>& cells) {
  static_assert(sizeof(std::array<Index, corners>) == corners * sizeof(Index));
  const auto connectivity = borrow<vtkTypeInt32Array>(reinterpret_cast<const vtkTypeInt32*>(cells.data()),
                                                      corners * cells.size(), 1);
  auto array = vtkSmartPointer<vtkCellArray>::New();
  array->SetData(static_cast<vtkIdType>(corners), connectivity);
  return array;
}

vtkSmartPointer<vtkDataArray> to_array(const Field& field, std::size_t count) {
  if (field.components < 1 || field.components > 3 ||
      field.values.size() != count * static_cast<std::size_t>(field.components)) {
    throw std::invalid_argument("field " + field.name + " has " + std::to_string(field.values.size()) +
                                " values for " + std::to_string(count) + " places of " +
                                std::to_string(field.components) + " components");
  }
  vtkSmartPointer<vtkFloatArray> array;
  if (field.components == 2) {
    array = vtkSmartPointer<vtkFloatArray>::New();
    array->SetNumberOfComponents(3);
    array->SetNumberOfTuples(static_cast<vtkIdType>(count));
    float* out = array->GetPointer(0);
    for (std::size_t i = 0; i < count; ++i) {
      *out++ = field.values[2 * i];
      *out++ = field.values[2 * i + 1];
      *out++ = 0.0F;
    }
  } else {
    array = borrow<vtkFloatArray>(field.values.data(), field.values.size(), field.components);
  }
  if (field.components == 3) {
    array->SetComponentName(0, "xx");
    array->SetComponentName(1, "yy");
    array->SetComponentName(2, "xy");
  }
  array->SetName(field.name.c_str());
  return array;
}

/// zlib's format, which meshio reads (not VTK's default LZ4), by libdeflate at its quickest: 25 ms for the
/// 5.8 MB of a frame of 1e5 triangles, which become 3.3 MB; zlib itself took 64 ms for 3.5 MB. To VTK, and in
/// the file, it is the class that it stands for.
class QuickZLib : public vtkZLibDataCompressor {
 public:
  static QuickZLib* New() {
    auto* made = new QuickZLib;
    made->InitializeObjectBase();
    return made;
  }
  size_t GetMaximumCompressionSpace(size_t size) override {
    return libdeflate_zlib_compress_bound(compressor_.get(), size);
  }

 protected:
  size_t CompressBuffer(const unsigned char* from, size_t size, unsigned char* to, size_t space) override {
    return libdeflate_zlib_compress(compressor_.get(), from, size, to, space);
  }

 private:
  QuickZLib() : compressor_(libdeflate_alloc_compressor(1), libdeflate_free_compressor) {
    if (!compressor_) throw std::bad_alloc();
  }
  std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor_;
};

/// VTK reports errors to a window or to stderr; here they are kept for the one message of CaseError.
void keep_error(vtkObject*, unsigned long, void* kept, void* text) {
  auto& first = *static_cast<std::string*>(kept);
  if (first.empty() && text != nullptr) first = static_cast<const char*>(text);
}

/// True when the file is complete: VTK does not check what the last flush, on closing, came to.
bool ends_whole(const std::string& path) {
  const std::string mark = "</VTKFile>\n";
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file || file.tellg() < static_cast<std::streamoff>(mark.size())) return false;
  std::string tail(mark.size(), '\0');
  file.seekg(-static_cast<std::streamoff>(mark.size()), std::ios::end);
  return file.read(tail.data(), static_cast<std::streamsize>(tail.size())) && tail == mark;
}

void write_grid(const std::string& path, vtkUnstructuredGrid* grid, double time) {
  vtkNew<vtkDoubleArray> time_value;
  time_value->SetName("TimeValue");
  time_value->InsertNextValue(time);
  grid->GetFieldData()->AddArray(time_value);

  // proves that the file can be made and says why not; VTK would not give the system's reason
  write_whole_file(path + ".tmp", "");

  std::string error;
  vtkNew<vtkCallbackCommand> listener;
  listener->SetCallback(keep_error);
  listener->SetClientData(&error);

  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->AddObserver(vtkCommand::ErrorEvent, listener);
  writer->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, listener);
  writer->SetFileName((path + ".tmp").c_str());
  writer->SetInputData(grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  vtkNew<QuickZLib> compressor;
  writer->SetCompressor(compressor);
  const bool written = writer->Write() == 1 && writer->GetErrorCode() == vtkErrorCode::NoError;
  if (!written || !ends_whole(path + ".tmp")) {
    const int code = static_cast<int>(writer->GetErrorCode());
    std::remove((path + ".tmp").c_str());
    // below its own codes VTK passes on those of the system
    if (code == vtkErrorCode::NoError || code == vtkErrorCode::OutOfDiskSpaceError) {
      throw_file_error(path, "write", ENOSPC);
    }
    if (code < vtkErrorCode::FirstVTKErrorCode) throw_file_error(path, "write", code);
    throw CaseError(
        path, 0, 0,
        std::string("cannot write: ") + vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()));
  }
  rename_finished(path);
}

/// The frame that stands for no fracture: meshio cannot read a grid without cells, so there is one line
/// of no length at the origin, with every value zero (not broken, not damaged).
FractureFrame without_fractures(FractureFrame frame) {
  frame.points = {{}, {}};
  frame.lines = {{0, 1}};
  for (Field& field : frame.cell_fields)
    field.values.assign(static_cast<std::size_t>(field.components), 0.0F);
  return frame;
}

}  // namespace

void write_vtu(const std::string& path, FieldFrame frame) {
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(to_points(frame.points));
  grid->SetCells(VTK_TRIANGLE, to_cells(frame.triangles));
  // What VTK has a copy of, with a third component, is let go at once.
  const std::size_t places = frame.points.size();
  frame.points = {};
  for (Field& field : frame.point_fields) {
    grid->GetPointData()->AddArray(to_array(field, places));
    if (field.components == 2) field.values = {};
  }
  for (const Field& field : frame.cell_fields) {
    grid->GetCellData()->AddArray(to_array(field, frame.triangles.size()));
  }
  write_grid(path, grid, frame.time);
}

void write_vtu(const std::string& path, const FractureFrame& frame) {
  if (frame.lines.empty()) return write_vtu(path, without_fractures(frame));
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(to_points(frame.points));
  grid->SetCells(VTK_LINE, to_cells(frame.lines));
  for (const Field& field : frame.cell_fields) {
    grid->GetCellData()->AddArray(to_array(field, frame.lines.size()));
  }
  write_grid(path, grid, frame.time);
}

}  // namespace crackle
