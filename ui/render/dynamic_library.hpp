#pragma once

#include <dlfcn.h>

#include <stdexcept>
#include <string>

namespace pliant::render {

/// A shared library opened at run time, so that the program starts without it. It stays open: Mesa leaves threads and
/// thread-local data behind that must not be unmapped.
class DynamicLibrary {
 public:
  /// Throws std::runtime_error if it cannot be opened. Its names stay local: two libraries of OpenGL must not mix.
  explicit DynamicLibrary(const std::string& name) : name_(name), handle_(dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL)) {
    if (!handle_) throw std::runtime_error(name + " cannot be opened: " + dlerror());
  }

  /// The function `name`; throws std::runtime_error if there is none.
  template <class Function>
  Function* function(const char* name) const {
    void* address = dlsym(handle_, name);
    if (!address) throw std::runtime_error(name_ + " has no function " + name);
    return reinterpret_cast<Function*>(address);
  }

 private:
  std::string name_;
  void* handle_;
};

}  // namespace pliant::render
