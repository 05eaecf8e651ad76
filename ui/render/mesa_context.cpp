#include <vector>

#include "ui/render/dynamic_library.hpp"
#include "ui/render/offscreen_context.hpp"

namespace pliant::render {
namespace {

// Declarations of libOSMesa (GL/osmesa.h) and of libglvnd's dispatch library (GLdispatch.h, interface 1), whose headers
// Debian does not install with the libraries.
constexpr int osmesaFormat = 0x22, osmesaRgba = 0x1908, osmesaDepthBits = 0x30, osmesaStencilBits = 0x31;
constexpr int osmesaProfile = 0x33, osmesaCoreProfile = 0x34, osmesaMajorVersion = 0x36, osmesaMinorVersion = 0x37;
constexpr unsigned glUnsignedByte = 0x1401;
constexpr int dispatchInterface = 1;
constexpr int threadStateTag = 2;  // 0 is GLX, 1 is EGL

using OsmesaProcedure = void (*)();

struct DispatchThreadState {
  int tag = threadStateTag;
  void (*threadDestroyed)(DispatchThreadState*) = [](DispatchThreadState*) {};
  void* priv = nullptr;
};

struct Libraries {
  DynamicLibrary mesa{"libOSMesa.so.8"};
  DynamicLibrary dispatch{"libGLdispatch.so.0"};

  void* (*createContext)(const int*, void*) = mesa.function<void*(const int*, void*)>("OSMesaCreateContextAttribs");
  void (*destroyContext)(void*) = mesa.function<void(void*)>("OSMesaDestroyContext");
  unsigned char (*mesaMakeCurrent)(void*, void*, unsigned, int, int) =
      mesa.function<unsigned char(void*, void*, unsigned, int, int)>("OSMesaMakeCurrent");
  OsmesaProcedure (*procedureAddress)(const char*) =
      mesa.function<OsmesaProcedure(const char*)>("OSMesaGetProcAddress");

  unsigned char (*dispatchMakeCurrent)(DispatchThreadState*, void*, int, const void*) =
      dispatch.function<unsigned char(DispatchThreadState*, void*, int, const void*)>("__glDispatchMakeCurrent");
  void (*dispatchLoseCurrent)() = dispatch.function<void()>("__glDispatchLoseCurrent");
  DispatchThreadState* (*currentThreadState)() =
      dispatch.function<DispatchThreadState*()>("__glDispatchGetCurrentThreadState");

  void* table = nullptr;
  int vendor = 0;

  Libraries() {
    if (dispatch.function<int()>("__glDispatchGetABIVersion")() != dispatchInterface)
      throw std::runtime_error("libGLdispatch.so.0 has another interface than the one known here");
    dispatch.function<void()>("__glDispatchInit")();
    vendor = dispatch.function<int()>("__glDispatchNewVendorID")();
    using Lookup = void* (*)(const char*, void*);
    const Lookup lookup = [](const char* name, void* self) {
      return reinterpret_cast<void*>(static_cast<Libraries*>(self)->procedureAddress(name));
    };
    table = dispatch.function<void*(Lookup, void*)>("__glDispatchCreateTable")(lookup, this);
    if (!table) throw std::runtime_error("libGLdispatch.so.0 makes no dispatch table");
  }

  // The table is shared by all contexts and lives as long as the program, like the libraries.
  static Libraries& instance() {
    static auto* libraries = new Libraries;
    return *libraries;
  }
};

class MesaContext final : public OffscreenContext {
 public:
  MesaContext() : libraries_(Libraries::instance()) {
    const int attributes[] = {osmesaFormat,
                              osmesaRgba,
                              osmesaDepthBits,
                              24,
                              osmesaStencilBits,
                              8,
                              osmesaProfile,
                              osmesaCoreProfile,
                              osmesaMajorVersion,
                              3,
                              osmesaMinorVersion,
                              3,
                              0};
    context_ = libraries_.createContext(attributes, nullptr);
    if (!context_) throw std::runtime_error("libOSMesa.so.8 makes no OpenGL 3.3 context");
  }

  ~MesaContext() override {
    doneCurrent();
    libraries_.destroyContext(context_);
  }

  std::string_view name() const override { return "OSMesa"; }

  bool isCurrent() const override { return libraries_.currentThreadState() == &state_; }

  void makeCurrent() override {
    if (isCurrent()) return;
    if (const DispatchThreadState* current = libraries_.currentThreadState()) {
      if (current->tag != threadStateTag) throw std::runtime_error("another OpenGL context is current on this thread");
      libraries_.dispatchLoseCurrent();
    }
    if (!libraries_.mesaMakeCurrent(context_, buffer_.data(), glUnsignedByte, bufferSize, bufferSize) ||
        !libraries_.dispatchMakeCurrent(&state_, libraries_.table, libraries_.vendor, nullptr))
      throw std::runtime_error("OSMesa's context cannot be made current");
  }

  void doneCurrent() override {
    if (!isCurrent()) return;
    libraries_.dispatchLoseCurrent();
    libraries_.mesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
  }

 private:
  static constexpr int bufferSize = 16;  // pictures are drawn into framebuffer objects, not here

  Libraries& libraries_;
  void* context_ = nullptr;
  DispatchThreadState state_;
  std::vector<unsigned char> buffer_ = std::vector<unsigned char>(4 * bufferSize * bufferSize);
};

}  // namespace

std::unique_ptr<OffscreenContext> makeMesaContext() { return std::make_unique<MesaContext>(); }

}  // namespace pliant::render
