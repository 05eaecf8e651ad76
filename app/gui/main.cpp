#include <CLI/CLI.hpp>
#include <QApplication>
#include <QFileInfo>
#include <cstdio>
#include <exception>
#include <string>

#include "ui/shell/main_window.hpp"

namespace {

/// Qt ends the program where it finds no display, so that is looked for first.
bool hasDisplay() {
  if (qEnvironmentVariableIsSet("QT_QPA_PLATFORM")) return true;
  return !qEnvironmentVariableIsEmpty("DISPLAY") || !qEnvironmentVariableIsEmpty("WAYLAND_DISPLAY");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App options{"Pliant: design of nonlinear mechanical systems", "pliant"};
  std::string scene;
  bool run = false;
  options.add_option("scene", scene, "Scene file to open");
  options.add_flag("--run", run, "Run the scene's studies at once");
  options.set_version_flag("--version", PLIANT_VERSION);
  options.allow_extras();  // Qt's own, such as -platform
  try {
    options.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return options.exit(error) == 0 ? 0 : 2;
  }
  bool platformGiven = false;
  for (const std::string& extra : options.remaining())
    platformGiven = platformGiven || extra.find("platform") != std::string::npos;
  if (!hasDisplay() && !platformGiven) {
    std::fputs("pliant: there is no display; use pliant-cli, or set DISPLAY or WAYLAND_DISPLAY.\n", stderr);
    return 2;
  }
  QApplication::setApplicationName(QStringLiteral("Pliant"));
  QApplication::setOrganizationName(QStringLiteral("Pliant"));
  QApplication::setApplicationVersion(QStringLiteral(PLIANT_VERSION));
  QApplication::setDesktopFileName(QStringLiteral("org.pliant.Pliant"));
  QApplication application(argc, argv);
  try {
    pliant::shell::MainWindow window(true);
    window.show();
    if (!scene.empty()) window.openFile(QFileInfo(QString::fromStdString(scene)).absoluteFilePath(), run);
    return QApplication::exec();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pliant: %s\n", error.what());
    return 2;
  }
}
