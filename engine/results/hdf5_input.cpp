#include "engine/results/hdf5_input.h"

#include <fmt/format.h>

#include <system_error>

#include "engine/core/error.h"

namespace burnish::inline results::hdf5 {
namespace {

constexpr std::size_t kLargestText = 1 << 16;  // bytes of a string attribute

/// No filter that results use compresses better than this (deflate: 1032), so a dataset that claims to be
/// larger is damaged; checked before memory is reserved for it.
constexpr hsize_t kLargestCompression = 1100;

Handle open(const std::filesystem::path& path) {
  silenceErrors();
  std::error_code status;
  if (!std::filesystem::exists(path, status))
    throw Error(fmt::format("{}: there is no such file", path.string()));
  if (std::filesystem::is_directory(path, status))
    throw Error(fmt::format("{} is a directory where an HDF5 file is expected", path.string()));
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // A file under its final name is never written again, and some network file systems refuse locks.
  H5Pset_file_locking(access.get(), false, true);
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose);
  if (file.valid()) return file;
  if (H5Fis_hdf5(path.c_str()) > 0)
    throw Error(fmt::format("{} is truncated or damaged; only the run that wrote it can make it again",
                            path.string()));
  throw Error(fmt::format("{} is not a readable HDF5 file, so it is no result of burnish", path.string()));
}

std::string untilPadding(const char* text, std::size_t length) {
  std::size_t end = length;
  while (end > 0 && text[end - 1] == '\0') --end;
  return {text, end};
}

bool isFixedString(hid_t type) {
  return H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0;
}

}  // namespace

void InputObject::fail(const std::string& what) const {
  throw Error(fmt::format("{}: {}; the file is damaged or was not written by burnish", place_, what));
}

bool InputObject::hasAttribute(const std::string& name) const {
  return H5Aexists(id(), name.c_str()) > 0;
}

Handle InputObject::openAttribute(const std::string& name) const {
  Handle attribute(H5Aopen(id(), name.c_str(), H5P_DEFAULT), H5Aclose);
  if (!attribute.valid()) fail(fmt::format("attribute {} is missing", name));
  return attribute;
}

void InputObject::readAttribute(const std::string& name, hid_t fileType, hid_t memoryType, hssize_t count,
                                void* values) const {
  const Handle attribute = openAttribute(name);
  const Handle type(H5Aget_type(attribute.get()), H5Tclose);
  const Handle space(H5Aget_space(attribute.get()), H5Sclose);
  if (H5Tequal(type.get(), fileType) <= 0 || H5Sget_simple_extent_npoints(space.get()) != count)
    fail(fmt::format("attribute {} has another type or length than expected", name));
  if (H5Aread(attribute.get(), memoryType, values) < 0)
    fail(fmt::format("attribute {} cannot be read", name));
}

int InputObject::integer(const std::string& attribute) const {
  int value = 0;
  readAttribute(attribute, H5T_STD_I32LE, H5T_NATIVE_INT, 1, &value);
  return value;
}

double InputObject::real(const std::string& attribute) const {
  double value = 0.0;
  readAttribute(attribute, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 1, &value);
  return value;
}

Eigen::Vector3d InputObject::vector3(const std::string& attribute) const {
  Eigen::Vector3d value;
  readAttribute(attribute, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 3, value.data());
  return value;
}

std::string InputObject::text(const std::string& attribute) const {
  const std::vector<std::string> values = texts(attribute);
  if (values.size() != 1)
    fail(fmt::format("attribute {} holds {} texts instead of one", attribute, values.size()));
  return values.front();
}

std::vector<std::string> InputObject::texts(const std::string& name) const {
  const Handle attribute = openAttribute(name);
  const Handle type(H5Aget_type(attribute.get()), H5Tclose);
  const Handle space(H5Aget_space(attribute.get()), H5Sclose);
  if (!isFixedString(type.get())) fail(fmt::format("attribute {} is not a text of fixed length", name));
  const std::size_t length = H5Tget_size(type.get());
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  if (count < 0 || length == 0 || length > kLargestText ||
      static_cast<std::size_t>(count) > kLargestText / length)
    fail(fmt::format("attribute {} is too long", name));
  const auto n = static_cast<std::size_t>(count);
  std::string padded(n * length + 1, '\0');
  if (H5Aread(attribute.get(), type.get(), padded.data()) < 0)
    fail(fmt::format("attribute {} cannot be read", name));
  std::vector<std::string> values;
  for (std::size_t i = 0; i < n; ++i) values.push_back(untilPadding(padded.data() + i * length, length));
  return values;
}

std::vector<hsize_t> InputDataset::shape(int dimensions) const {
  const Handle space(H5Dget_space(id()), H5Sclose);
  if (H5Sget_simple_extent_type(space.get()) != H5S_SIMPLE ||
      H5Sget_simple_extent_ndims(space.get()) != dimensions)
    fail(fmt::format("not a dataset with {} dimension{}", dimensions, dimensions == 1 ? "" : "s"));
  std::vector<hsize_t> extents(static_cast<std::size_t>(dimensions));
  if (H5Sget_simple_extent_dims(space.get(), extents.data(), nullptr) < 0) fail("its shape cannot be read");
  hsize_t items = 1;
  for (const hsize_t extent : extents) {
    if (extent > (hsize_t{1} << 31) || (extent > 0 && items > (hsize_t{1} << 40) / extent))
      fail("it is too large");
    items *= extent;
  }
  checkStorage(items * H5Tget_size(Handle(H5Dget_type(id()), H5Tclose).get()));
  return extents;
}

void InputDataset::checkStorage(hsize_t bytes) const {
  if (bytes / kLargestCompression > H5Dget_storage_size(id()))
    fail("it claims more data than the file can hold");
}

void InputDataset::read(hid_t fileType, hid_t memoryType, void* values) const {
  const Handle type(H5Dget_type(id()), H5Tclose);
  if (H5Tequal(type.get(), fileType) <= 0) fail("its numbers have another type than expected");
  if (values && H5Dread(id(), memoryType, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
    fail("it cannot be read");
}

Eigen::MatrixXd InputDataset::matrix() const {
  const std::vector<hsize_t> extents = shape(2);
  Eigen::MatrixXd values(static_cast<Eigen::Index>(extents[1]), static_cast<Eigen::Index>(extents[0]));
  read(H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.data());
  return values;
}

Eigen::VectorXd InputDataset::vector() const {
  Eigen::VectorXd values(static_cast<Eigen::Index>(shape(1)[0]));
  read(H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.data());
  return values;
}

std::vector<int> InputDataset::integers() const {
  std::vector<int> values(static_cast<std::size_t>(shape(1)[0]));
  read(H5T_STD_I32LE, H5T_NATIVE_INT, values.data());
  return values;
}

std::string InputDataset::string() const {
  const Handle type(H5Dget_type(id()), H5Tclose);
  const Handle space(H5Dget_space(id()), H5Sclose);
  if (!isFixedString(type.get()) || H5Sget_simple_extent_type(space.get()) != H5S_SCALAR)
    fail("not a single text of fixed length");
  const std::size_t length = H5Tget_size(type.get());
  checkStorage(length);
  std::string padded(length + 1, '\0');
  if (H5Dread(id(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()) < 0) fail("it cannot be read");
  return untilPadding(padded.data(), length);
}

InputGroup InputGroup::group(const std::string& name) const {
  Handle child(H5Gopen2(id(), name.c_str(), H5P_DEFAULT), H5Gclose);
  if (!child.valid()) fail(fmt::format("group {} is missing or unreadable", name));
  return {std::move(child), fmt::format("{}/{}", place(), name)};
}

InputDataset InputGroup::dataset(const std::string& name) const {
  Handle child(H5Dopen2(id(), name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!child.valid()) fail(fmt::format("dataset {} is missing or unreadable", name));
  return {std::move(child), fmt::format("{}/{}", place(), name)};
}

bool InputGroup::contains(const std::string& name) const {
  const htri_t exists = H5Lexists(id(), name.c_str(), H5P_DEFAULT);
  if (exists < 0) fail("its members cannot be listed");
  return exists > 0;
}

std::vector<std::string> InputGroup::names() const {
  H5G_info_t info;
  if (H5Gget_info(id(), &info) < 0) fail("its members cannot be listed");
  std::vector<std::string> names;
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    const auto name = [&](char* text, std::size_t size) {
      return H5Lget_name_by_idx(id(), ".", H5_INDEX_NAME, H5_ITER_INC, i, text, size, H5P_DEFAULT);
    };
    const ssize_t length = name(nullptr, 0);
    if (length < 0) fail("its members cannot be listed");
    std::string text(static_cast<std::size_t>(length) + 1, '\0');
    if (name(text.data(), text.size()) < 0) fail("its members cannot be listed");
    text.pop_back();
    names.push_back(std::move(text));
  }
  return names;
}

InputFile::InputFile(const std::filesystem::path& path) : name_(path.string()), file_(open(path)) {}

InputGroup InputFile::root() const {
  Handle root(H5Gopen2(file_.get(), "/", H5P_DEFAULT), H5Gclose);
  if (!root.valid()) throw Error(fmt::format("{} is truncated or damaged", name_));
  return {std::move(root), name_};
}

}  // namespace burnish::inline results::hdf5
