// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/io/checkpoint.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <new>

#include "crackle/core/errors.hpp"

namespace crackle {
namespace {

// An HDF5 user block may be 512, 1024, ... bytes long.
constexpr std::size_t head_bytes = 512;
constexpr std::string_view magic = "crackle checkpoint\n";
constexpr std::string_view no_checksum = "0000000000000000";
constexpr const char* text_name = "case";

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
  throw CaseError(name + ": " + why);
}

// FNV-1a, 64 bits (Fowler, Noll, Vo): one byte changed always changes it.
std::uint64_t hash(std::string_view bytes, std::uint64_t before = 0xcbf29ce484222325u) {
  for (const char c : bytes) before = (before ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return before;
}

std::string head_text(const CheckpointHead& head, std::size_t bytes, std::string_view checksum) {
  std::string text(magic);
  text += fmt::format("format {}\nprogram {}\nstep {}\ntime {}\nbytes {}\nchecksum {}\n", checkpoint_format,
                      head.program, head.step, head.time, bytes, checksum);
  text.resize(head_bytes, '\n');
  return text;
}

/// The value behind a key at the start of a line.
std::string_view value_of(std::string_view head, std::string_view key) {
  const std::size_t line = head.find(fmt::format("\n{} ", key));
  if (line == std::string_view::npos) return {};
  const std::size_t value = line + key.size() + 2;
  return head.substr(value, head.find('\n', value) - value);
}

template <class T>
T number_in(std::string_view text, const std::string& name) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) refuse(name, "the head is damaged");
  return value;
}

/// An HDF5 object that is closed with its scope.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): stands for the id

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

// Errors of the library become ours; it shall not print them.
class SilentErrors {
 public:
  SilentErrors() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~SilentErrors() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  SilentErrors(const SilentErrors&) = delete;
  SilentErrors& operator=(const SilentErrors&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

hid_t file_type(Number number) {
  switch (number) {
    case Number::float64:
      return H5T_IEEE_F64LE;
    case Number::int64:
      return H5T_STD_I64LE;
    case Number::int32:
      return H5T_STD_I32LE;
    case Number::uint16:
      return H5T_STD_U16LE;
    case Number::int8:
      return H5T_STD_I8LE;
    case Number::uint8:
      return H5T_STD_U8LE;
  }
  return -1;
}

hid_t memory_type(Number number) {
  switch (number) {
    case Number::float64:
      return H5T_NATIVE_DOUBLE;
    case Number::int64:
      return H5T_NATIVE_INT64;
    case Number::int32:
      return H5T_NATIVE_INT32;
    case Number::uint16:
      return H5T_NATIVE_UINT16;
    case Number::int8:
      return H5T_NATIVE_INT8;
    case Number::uint8:
      return H5T_NATIVE_UINT8;
  }
  return -1;
}

std::vector<hsize_t> shape_of(const Column& column, std::size_t count) {
  std::vector<hsize_t> shape;
  if (column.list) shape.push_back(count);
  if (column.components > 1) shape.push_back(column.components);
  return shape;
}

hid_t new_space(const std::vector<hsize_t>& shape) {
  return shape.empty() ? H5Screate(H5S_SCALAR)
                       : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
}

// In memory: what goes to the disk is written by one who says why it cannot.
hid_t memory_file_access() {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  constexpr std::size_t grow_by = 1 << 22;
  H5Pset_fapl_core(access, grow_by, false);
  return access;
}

void write_column(hid_t file, hid_t links, const Column& column, std::vector<std::byte>& buffer) {
  buffer.resize(column.count * column.item_bytes());
  column.gather(buffer.data());
  const Handle space(new_space(shape_of(column, column.count)), H5Sclose);
  const Handle set(
      H5Dcreate2(file, column.name.c_str(), file_type(column.number), space, links, H5P_DEFAULT, H5P_DEFAULT),
      H5Dclose);
  if (set < 0 || H5Dwrite(set, memory_type(column.number), H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer.data()) < 0)
    throw std::bad_alloc();  // in memory nothing else can be wrong
}

void write_text(hid_t file, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, text.size() + 1);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle set(H5Dcreate2(file, text_name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  if (set < 0 || H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()) < 0) throw std::bad_alloc();
}

/// Bytes that a data set has in the file; 0 where it claims more than there are.
std::size_t stored_bytes(hid_t file, hid_t set) {
  hsize_t there = 0;
  H5Fget_filesize(file, &there);
  const hsize_t stored = H5Dget_storage_size(set);
  return stored <= there ? static_cast<std::size_t>(stored) : 0;
}

std::string read_text(hid_t file, const std::string& name) {
  const Handle set(H5Dopen2(file, text_name, H5P_DEFAULT), H5Dclose);
  if (set < 0) refuse(name, "there is no case in it");
  const Handle type(H5Dget_type(set), H5Tclose);
  std::string text(std::min(H5Tget_size(type), stored_bytes(file, set)), '\0');
  if (text.size() != H5Tget_size(type) || H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0)
    refuse(name, "its case cannot be read");
  text.resize(std::min(text.size(), text.find('\0')));
  return text;
}

/// The items of a column in the file; how many is in `count`.
std::vector<std::byte> read_column(hid_t file, const std::string& name, const Column& column,
                                   std::size_t& count) {
  const auto refuse_column = [&](const char* why) {
    refuse(name,
           fmt::format("{} {}: it was written by a crackle that keeps other numbers; resume it with that "
                       "version, or start the run anew",
                       column.name, why));
  };
  const Handle set(H5Dopen2(file, column.name.c_str(), H5P_DEFAULT), H5Dclose);
  if (set < 0) refuse_column("is not in it");
  const Handle type(H5Dget_type(set), H5Tclose);
  if (H5Tequal(type, file_type(column.number)) <= 0) refuse_column("holds other numbers");
  const Handle space(H5Dget_space(set), H5Sclose);
  std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  count = column.list && !shape.empty() ? shape.front() : 1;
  if (shape != shape_of(column, count)) refuse_column("has another shape");
  const std::size_t stored = stored_bytes(file, set);
  if (stored / column.item_bytes() != count || stored % column.item_bytes() != 0)  // the product may overflow
    refuse_column("has no data");
  std::vector<std::byte> items(count * column.item_bytes());
  if (H5Dread(set, memory_type(column.number), H5S_ALL, H5S_ALL, H5P_DEFAULT, items.data()) < 0)
    refuse_column("cannot be read");
  return items;
}

}  // namespace

std::string pack_checkpoint(const CheckpointHead& head, const std::vector<Column>& columns,
                            const std::string& text) {
  const SilentErrors silent;
  const Handle access(memory_file_access(), H5Pclose);
  const Handle file(H5Fcreate("checkpoint", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links, 1);
  if (file < 0) throw std::bad_alloc();
  std::vector<std::byte> buffer;
  for (const Column& column : columns) write_column(file, links, column, buffer);
  write_text(file, text);
  H5Fflush(file, H5F_SCOPE_GLOBAL);
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  if (size < 0) throw std::bad_alloc();
  std::string bytes(head_bytes + static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(file, bytes.data() + head_bytes, static_cast<std::size_t>(size)) != size)
    throw std::bad_alloc();
  const std::string unsealed = head_text(head, bytes.size(), no_checksum);
  const std::uint64_t sum = hash(std::string_view(bytes).substr(head_bytes), hash(unsealed));
  bytes.replace(0, head_bytes, head_text(head, bytes.size(), fmt::format("{:016x}", sum)));
  return bytes;
}

CheckpointHead checkpoint_head(std::string_view bytes, const std::string& name) {
  if (!bytes.starts_with(magic)) refuse(name, "this is not a checkpoint of crackle");
  if (bytes.size() < head_bytes) refuse(name, "it is cut short within its head");
  const std::string_view head = bytes.substr(0, head_bytes);
  const int format = number_in<int>(value_of(head, "format"), name);
  if (format != checkpoint_format) {
    refuse(name,
           fmt::format("a checkpoint of format {} (crackle {}), this crackle reads format {}: resume it "
                       "with the version that wrote it",
                       format, value_of(head, "program"), checkpoint_format));
  }
  const auto length = number_in<std::size_t>(value_of(head, "bytes"), name);
  if (length != bytes.size())
    refuse(name, fmt::format("it is {} bytes long instead of {}: cut short", bytes.size(), length));
  std::string unsealed(head);
  const std::string_view checksum = value_of(head, "checksum");
  if (checksum.size() != no_checksum.size()) refuse(name, "the head is damaged");
  unsealed.replace(static_cast<std::size_t>(checksum.data() - head.data()), checksum.size(), no_checksum);
  const std::uint64_t sum = hash(bytes.substr(head_bytes), hash(unsealed));
  if (fmt::format("{:016x}", sum) != checksum) refuse(name, "it is damaged: its checksum is wrong");
  return {std::string(value_of(head, "program")), number_in<std::int64_t>(value_of(head, "step"), name),
          number_in<double>(value_of(head, "time"), name)};
}

std::string unpack_checkpoint(std::string_view bytes, const std::string& name,
                              const std::vector<Column>& columns) {
  checkpoint_head(bytes, name);
  const SilentErrors silent;
  const Handle access(memory_file_access(), H5Pclose);
  std::string image(bytes.substr(head_bytes));
  H5Pset_file_image(access, image.data(), image.size());
  const Handle file(H5Fopen("checkpoint", H5F_ACC_RDONLY, access), H5Fclose);
  if (file < 0) refuse(name, "it holds no HDF5 file");
  std::string text = read_text(file, name);
  std::vector<std::vector<std::byte>> items;
  std::vector<std::size_t> counts(columns.size());
  for (std::size_t c = 0; c < columns.size(); ++c)
    items.push_back(read_column(file, name, columns[c], counts[c]));
  for (std::size_t c = 0; c < columns.size(); ++c) columns[c].scatter(items[c].data(), counts[c]);
  return text;
}

}  // namespace crackle
