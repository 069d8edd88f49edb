#pragma once
#include <Eigen/Dense>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/results/hdf5_handle.h"

namespace burnish::inline results::hdf5 {

/// A group or dataset that is being read. Whatever is missing, of another type or unreadable throws `Error`
/// with the file and the object's path in it.
class InputObject {
 public:
  int integer(const std::string& attribute) const;
  double real(const std::string& attribute) const;
  Eigen::Vector3d vector3(const std::string& attribute) const;
  std::string text(const std::string& attribute) const;
  std::vector<std::string> texts(const std::string& attribute) const;

  bool hasAttribute(const std::string& attribute) const;

  /// File and path of the object, for messages.
  const std::string& place() const { return place_; }

 protected:
  InputObject(Handle object, std::string place) : object_(std::move(object)), place_(std::move(place)) {}
  hid_t id() const { return object_.get(); }

  [[noreturn]] void fail(const std::string& what) const;

 private:
  friend class InputFile;
  friend class InputGroup;

  Handle openAttribute(const std::string& name) const;
  void readAttribute(const std::string& name, hid_t fileType, hid_t memoryType, hssize_t count,
                     void* values) const;

  Handle object_;
  std::string place_;
};

class InputDataset : public InputObject {
 public:
  InputDataset(Handle dataset, std::string place) : InputObject(std::move(dataset), std::move(place)) {}

  /// The transpose of a two-dimensional dataset: shape (n, m) gives m x n.
  Eigen::MatrixXd matrix() const;
  Eigen::VectorXd vector() const;
  std::vector<int> integers() const;
  std::string string() const;

 private:
  std::vector<hsize_t> shape(int dimensions) const;
  void read(hid_t fileType, hid_t memoryType, void* values) const;
  void checkStorage(hsize_t bytes) const;
};

class InputGroup : public InputObject {
 public:
  InputGroup(Handle group, std::string place) : InputObject(std::move(group), std::move(place)) {}

  InputGroup group(const std::string& name) const;
  InputDataset dataset(const std::string& name) const;

  bool contains(const std::string& name) const;

  /// Names of all members in alphabetical order.
  std::vector<std::string> names() const;
};

/// An HDF5 file opened for reading. Throws `Error` if it does not exist, is not HDF5, or is truncated.
class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& path);
  InputGroup root() const;

 private:
  std::string name_;
  Handle file_;
};

}  // namespace burnish::inline results::hdf5
