#include <assimp/scene.h>
#include <Eigen/Geometry>
#include <QFile>
#include <QIODevice>
#include <QTemporaryDir>
#include <QTest>
#include <assimp/Importer.hpp>
#include <cmath>

#include "core/base/error.hpp"
#include "core/geometry/mesh_generators.hpp"
#include "core/geometry/surface_mesh.hpp"

using namespace pliant;
using geometry::SurfaceMesh;

class TestMeshFiles : public QObject {
  Q_OBJECT

 private slots:
  void whatIsWrittenReadsBack_data();
  void whatIsWrittenReadsBack();
  void printFilesAreInMillimetres();
  void textFilesAreRead_data();
  void textFilesAreRead();
  void badFilesAreRefused_data();
  void badFilesAreRefused();
  void cutFilesNeverCrash_data() { whatIsWrittenReadsBack_data(); }
  void cutFilesNeverCrash();
  void badTargetsAreRefused();
  void wingOfAnotherGenerator();

 private:
  std::filesystem::path path(const std::string& name) const { return folder_.filePath(name.c_str()).toStdString(); }
  void write(const std::string& name, const QByteArray& content) const {
    QFile file(folder_.filePath(name.c_str()));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(content);
  }

  QTemporaryDir folder_;
};

void TestMeshFiles::whatIsWrittenReadsBack_data() {
  QTest::addColumn<QString>("extension");
  for (const char* extension : {"stl", "obj", "ply", "gltf", "glb", "STL"}) QTest::newRow(extension) << extension;
}

void TestMeshFiles::whatIsWrittenReadsBack() {
  QFETCH(QString, extension);
  SurfaceMesh mesh = geometry::makeFork({0.13, 0.14, 0.02, 0.043, 13, 14, 2});
  for (Eigen::Index n = 0; n < mesh.points.cols(); ++n) mesh.points(2, n) = 0.02 * std::sin(30 * mesh.points(0, n));
  const auto file = path("fork." + extension.toStdString());
  geometry::writeMesh(mesh, file);
  const SurfaceMesh back = geometry::weldMesh(geometry::readMesh(file, 1), 1e-6);
  QCOMPARE(back.points.cols(), mesh.points.cols());
  QCOMPARE(back.triangles.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i)  // floats: 2^-24 of 0.3 m, and the welding
      QVERIFY((back.points.col(back.triangles[t][i]) - mesh.points.col(mesh.triangles[t][i])).norm() <= 1e-7);

  const SurfaceMesh scaled = geometry::readMesh(file, 1000);
  QVERIFY(std::abs(scaled.points.row(0).maxCoeff() - 290) <= 1e-4);
}

void TestMeshFiles::printFilesAreInMillimetres() {
  const SurfaceMesh mesh = geometry::makeGrid(0.2, 0.1, 3, 2);
  geometry::writeMesh(mesh, path("a.3mf"));
  QVERIFY_EXCEPTION_THROWN(geometry::readMesh(path("a.3mf"), 1), base::InputError);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path("a.3mf").string(), 0);
  QVERIFY(scene && scene->mNumMeshes == 1);
  const aiMesh& back = *scene->mMeshes[0];
  QCOMPARE(std::size_t(back.mNumFaces), mesh.triangles.size());
  QCOMPARE(Eigen::Index(back.mNumVertices), mesh.points.cols());
  for (unsigned n = 0; n < back.mNumVertices; ++n) {
    const Eigen::Vector3d place(back.mVertices[n].x, back.mVertices[n].y, back.mVertices[n].z);
    QVERIFY((place - 1000 * mesh.points.col(n)).norm() <= 1e-3);  // six digits
  }
}

void TestMeshFiles::textFilesAreRead_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QByteArray>("content");
  QTest::addColumn<int>("triangles");
  QTest::newRow("stl") << "a.stl"
                       << QByteArray(
                              "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                              "vertex 0 2 0\nendloop\nendfacet\nendsolid a\n")
                       << 1;
  QTest::newRow("obj, a quadrilateral and a stray point")
      << "a.obj" << QByteArray("v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 9 9 9\nf 1 2 3 4\n") << 2;
  QTest::newRow("ply") << "a.ply"
                       << QByteArray(
                              "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                              "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                              "end_header\n0 0 0\n1 0 0\n0 2 0\n9 9 9\n3 0 1 2\n")
                       << 1;
}

void TestMeshFiles::textFilesAreRead() {
  QFETCH(QString, name);
  QFETCH(QByteArray, content);
  QFETCH(int, triangles);
  write(name.toStdString(), content);
  const SurfaceMesh mesh = geometry::weldMesh(geometry::readMesh(path(name.toStdString()), 0.5), 1e-6);
  QCOMPARE(static_cast<int>(mesh.triangles.size()), triangles);
  QCOMPARE(static_cast<int>(mesh.points.cols()), triangles + 2);
  QCOMPARE(mesh.points.row(0).maxCoeff(), 0.5);
  QCOMPARE(mesh.points.row(1).maxCoeff(), 1.0);
}

void TestMeshFiles::badFilesAreRefused_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QByteArray>("content");
  QTest::newRow("empty") << "b.stl" << QByteArray();
  QTest::newRow("not a mesh") << "c.ply" << QByteArray("this is no mesh at all");
  QTest::newRow("points alone") << "d.obj" << QByteArray("v 0 0 0\nv 1 0 0\n");
  QTest::newRow("unknown format") << "e.docx" << QByteArray("v 0 0 0\nv 1 0 0\n");
  QTest::newRow("no faces in STL") << "f.stl" << QByteArray("solid a\nendsolid a\n");
  QTest::newRow("index out of range")
      << "g.ply"
      << QByteArray(
             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float "
             "y\nproperty float z\nelement face 1\nproperty list uchar int "
             "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 2 0\n3 0 1 77\n");
}

void TestMeshFiles::badFilesAreRefused() {
  QFETCH(QString, name);
  QFETCH(QByteArray, content);
  write(name.toStdString(), content);
  QVERIFY_EXCEPTION_THROWN(geometry::readMesh(path(name.toStdString()), 1), base::InputError);
}

void TestMeshFiles::cutFilesNeverCrash() {
  QFETCH(QString, extension);
  const std::string name = "whole." + extension.toStdString();
  geometry::writeMesh(geometry::makeGrid(1, 1, 3, 3), path(name));
  QFile file(folder_.filePath(name.c_str()));
  QVERIFY(file.open(QIODevice::ReadOnly));
  const QByteArray whole = file.readAll();
  for (int part = 0; part < 40; ++part) {
    const std::string cut = "cut." + extension.toStdString();
    write(cut, whole.left(whole.size() * part / 40));
    try {
      geometry::checkMesh(geometry::readMesh(path(cut), 1));  // a part may still be a mesh
    } catch (const base::InputError& error) {
      QVERIFY(!error.problem().empty());
    }
  }
}

void TestMeshFiles::badTargetsAreRefused() {
  const SurfaceMesh mesh = geometry::makeGrid(1, 1, 1, 1);
  QVERIFY_EXCEPTION_THROWN(geometry::writeMesh(mesh, path("no/such/folder/a.stl")), base::InputError);
  QVERIFY_EXCEPTION_THROWN(geometry::writeMesh(mesh, path("a.xyz")), base::InputError);
  QVERIFY_EXCEPTION_THROWN(geometry::writeMesh(SurfaceMesh(), path("a.stl")), base::InputError);
  QVERIFY_EXCEPTION_THROWN(geometry::readMesh(path("missing.stl"), 1), base::InputError);
  QVERIFY_EXCEPTION_THROWN(geometry::readMesh(folder_.path().toStdString(), 1), base::InputError);
  geometry::writeMesh(mesh, path("a.stl"));
  QVERIFY_EXCEPTION_THROWN(geometry::readMesh(path("a.stl"), -1), base::InputError);
}

void TestMeshFiles::wingOfAnotherGenerator() {
  const std::filesystem::path file = PLIANT_SOURCE_DIR "/scenes/assets/dragon_wing.stl";
  const SurfaceMesh mesh = geometry::weldMesh(geometry::readMesh(file, 1), 1e-6);
  QCOMPARE(mesh.triangles.size(), std::size_t(281));
  QCOMPARE(mesh.points.cols(), 165);
  // One piece without holes, V - E + F = 1.
  QCOMPARE(165 - static_cast<int>(geometry::meshEdges(mesh.triangles).size()) + 281, 1);
  QVERIFY(mesh.points.row(2).isZero(0));
  QVERIFY(std::abs(mesh.points.row(0).minCoeff()) <= 1e-7 && std::abs(mesh.points.row(0).maxCoeff() - 0.25) <= 1e-7);
  for (const auto& triangle : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d p = mesh.points.col(triangle[i]);
      const Eigen::Vector3d u = mesh.points.col(triangle[(i + 1) % 3]) - p;
      const Eigen::Vector3d v = mesh.points.col(triangle[(i + 2) % 3]) - p;
      const double angle = std::atan2(u.cross(v).z(), u.dot(v));  // positive: all triangles look upwards
      QVERIFY(angle > 35 * M_PI / 180 && angle < 110 * M_PI / 180);
    }
}

QTEST_GUILESS_MAIN(TestMeshFiles)
#include "test_mesh_files.moc"
