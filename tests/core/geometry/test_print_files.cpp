#include <assimp/scene.h>
#include <QFile>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>
#include <assimp/Importer.hpp>
#include <cmath>

#include "core/base/error.hpp"
#include "core/geometry/closed_mesh.hpp"
#include "core/geometry/print_files.hpp"

using namespace pliant::geometry;
using Eigen::Vector3d;

namespace {

SurfaceMesh tetrahedron(double size) {
  SurfaceMesh mesh;
  mesh.points = size * (Eigen::Matrix3Xd(3, 4) << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1).finished();
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  return mesh;
}

/// Corners of all triangles that assimp finds below a node, with its transformations [mm].
void collect(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent, std::vector<Vector3d>& corners) {
  const aiMatrix4x4 transform = parent * node.mTransformation;
  for (unsigned m = 0; m < node.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[m]];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f)
      for (unsigned i = 0; i < mesh.mFaces[f].mNumIndices; ++i) {
        const aiVector3D p = transform * mesh.mVertices[mesh.mFaces[f].mIndices[i]];
        corners.emplace_back(p.x, p.y, p.z);
      }
  }
  for (unsigned child = 0; child < node.mNumChildren; ++child)
    collect(scene, *node.mChildren[child], transform, corners);
}

std::vector<Vector3d> cornersIn(const std::string& file) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file, 0);
  std::vector<Vector3d> corners;
  if (scene) collect(*scene, *scene->mRootNode, aiMatrix4x4(), corners);
  return corners;
}

}  // namespace

class TestPrintFiles : public QObject {
  Q_OBJECT

  const std::vector<SurfaceMesh> bodies_ = {tetrahedron(1e-3), tetrahedron(2.5e-3)};
  const std::vector<BodyCopy> copies_ = {
      {1, Eigen::Matrix3d::Identity(), {0, 0, 0}},
      {0, Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix(), {10e-3, 20e-3, 3e-3}},
      {1, Eigen::AngleAxisd(-2, Vector3d(0, 1, 1).normalized()).toRotationMatrix(), {30e-3, 1e-3, 7e-3}}};

  /// What both files must hold, in millimetres.
  std::vector<Vector3d> expected() const {
    std::vector<Vector3d> corners;
    for (const auto& [body, rotation, position] : copies_)
      for (const auto& triangle : bodies_[body].triangles)
        for (const int corner : triangle)
          corners.push_back(1e3 * (rotation * bodies_[body].points.col(corner) + position));
    return corners;
  }

 private slots:
  /// Another program's reader finds every copy where it belongs, in millimetres.
  void readBack_data() {
    QTest::addColumn<QString>("name");
    QTest::newRow("stl") << "copies.stl";
    QTest::newRow("3mf") << "copies.3mf";
  }
  void readBack() {
    QFETCH(QString, name);
    QTemporaryDir folder;
    const std::string file = folder.filePath(name).toStdString();
    if (name.endsWith("stl"))
      writePrintStl(bodies_, copies_, file);
    else
      writePrint3mf(bodies_, copies_, file);
    const std::vector<Vector3d> found = cornersIn(file), wanted = expected();
    QCOMPARE(found.size(), wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i) QVERIFY((found[i] - wanted[i]).norm() < 1e-5);
  }

  /// The archive is sound for another program, check sums included, and holds each body once.
  void archive() {
    QTemporaryDir folder;
    const QString file = folder.filePath("copies.3mf");
    writePrint3mf(bodies_, copies_, file.toStdString(), {"small", "large, round"});
    QProcess python;
    python.start("python3",
                 {"-c",
                  "import sys, zipfile, xml.dom.minidom as dom\n"
                  "archive = zipfile.ZipFile(sys.argv[1])\n"
                  "model = dom.parseString(archive.read('3D/3dmodel.model'))\n"
                  "count = lambda tag: len(model.getElementsByTagName(tag))\n"
                  "print(archive.testzip(), len(archive.namelist()), count('object'), count('item'), count('vertex'), "
                  "count('triangle'), model.documentElement.getAttribute('unit'), "
                  "model.getElementsByTagName('object')[1].getAttribute('name'))",
                  file});
    QVERIFY(python.waitForFinished());
    QCOMPARE(python.readAllStandardOutput().trimmed(), "None 3 2 3 8 8 millimeter large, round");
  }

  void sameBytes() {
    QTemporaryDir folder;
    QByteArray bytes[2];
    for (int i = 0; i < 2; ++i) {
      QFile file(folder.filePath(QString::number(i) + ".3mf"));
      writePrint3mf(bodies_, copies_, file.fileName().toStdString());
      QVERIFY(file.open(QIODevice::ReadOnly));
      bytes[i] = file.readAll();
    }
    QVERIFY(!bytes[0].isEmpty() && bytes[0] == bytes[1]);
  }

  void assembledMesh() {
    const SurfaceMesh mesh = assembled(bodies_, copies_);
    QCOMPARE(mesh.points.cols(), 12);
    checkClosed(mesh);
    QVERIFY(std::abs(enclosedVolume(mesh) - (1 + 2 * 2.5 * 2.5 * 2.5) * 1e-9 / 6) < 1e-22);
  }

  void unwritable() {
    QVERIFY_THROWS_EXCEPTION(pliant::base::InputError, writePrintStl(bodies_, copies_, "/nowhere/at/all.stl"));
    QVERIFY_THROWS_EXCEPTION(pliant::base::InputError, writePrint3mf(bodies_, copies_, "/nowhere/at/all.3mf"));
  }
};

QTEST_GUILESS_MAIN(TestPrintFiles)
#include "test_print_files.moc"
