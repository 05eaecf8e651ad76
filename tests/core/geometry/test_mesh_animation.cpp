#include <assimp/scene.h>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <assimp/Importer.hpp>
#include <cmath>

#include "core/base/error.hpp"
#include "core/geometry/mesh_animation.hpp"

namespace pliant::geometry {

namespace {

MeshAnimation swayingSquare(int frames) {
  MeshAnimation animation;
  animation.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (int i = 0; i < frames; ++i) {
    Eigen::Matrix3Xd points(3, 4);
    points << 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0;
    points.row(2).setConstant(0.25 * i);
    points(0, 2) += 0.125 * i;
    animation.frames.push_back(points);
    animation.times.push_back(0.5 * i);
  }
  return animation;
}

}  // namespace

/// Animated meshes as another library reads them.
class TestMeshAnimation : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void everyFrameIsAMorphTarget() {
    QTemporaryDir folder;
    const std::string file = folder.filePath("square.glb").toStdString();
    const MeshAnimation animation = swayingSquare(4);
    writeAnimation(animation, file);
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(file, 0);
    QVERIFY2(scene, importer.GetErrorString());
    QCOMPARE(scene->mNumMeshes, 1u);
    const aiMesh& mesh = *scene->mMeshes[0];
    QCOMPARE(mesh.mNumVertices, 4u);
    QCOMPARE(mesh.mNumFaces, 2u);
    QCOMPARE(mesh.mNumAnimMeshes, 3u);
    for (unsigned target = 0; target < 3; ++target)
      for (unsigned i = 0; i < 4; ++i)
        for (unsigned axis = 0; axis < 3; ++axis)
          QCOMPARE(double(mesh.mAnimMeshes[target]->mVertices[i][axis]), animation.frames[target + 1](axis, i));
    QCOMPARE(scene->mNumAnimations, 1u);
    QCOMPARE(scene->mAnimations[0]->mNumMorphMeshChannels, 1u);
    const aiMeshMorphAnim& channel = *scene->mAnimations[0]->mMorphMeshChannels[0];
    QCOMPARE(channel.mNumKeys, 4u);
    for (unsigned key = 0; key < 4; ++key)
      for (unsigned target = 0; target < 3; ++target)
        QCOMPARE(channel.mKeys[key].mWeights[target], key == target + 1 ? 1.0 : 0.0);
    QVERIFY(std::abs(channel.mKeys[3].mTime / channel.mKeys[1].mTime - 3) < 1e-6);
  }

  void oneFrameIsAPlainMesh() {
    QTemporaryDir folder;
    const std::string file = folder.filePath("square.glb").toStdString();
    writeAnimation(swayingSquare(1), file);
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(file, 0);
    QVERIFY2(scene, importer.GetErrorString());
    QCOMPARE(scene->mNumAnimations, 0u);
  }

  void whatCannotBeWrittenIsRefused() {
    QTemporaryDir folder;
    const std::string file = folder.filePath("square.glb").toStdString();
    MeshAnimation none = swayingSquare(2), backwards = none, broken = none, other = none, outside = none;
    none.frames.clear();
    none.times.clear();
    backwards.times = {1, 1};
    broken.frames[1](0, 0) = NAN;
    other.frames[1].conservativeResize(3, 3);
    outside.triangles[0][0] = 4;
    for (const MeshAnimation& bad : {none, backwards, broken, other, outside})
      QVERIFY_EXCEPTION_THROWN(writeAnimation(bad, file), base::InputError);
    QVERIFY(!QFile::exists(QString::fromStdString(file)));
    QVERIFY_EXCEPTION_THROWN(writeAnimation(swayingSquare(2), "/nonexistent/square.glb"), base::InputError);
  }
};

}  // namespace pliant::geometry

QTEST_GUILESS_MAIN(pliant::geometry::TestMeshAnimation)
#include "test_mesh_animation.moc"
