// label: unit
// ranks: 1 3
#include <catch2/catch.hpp>

#include <numbers>

#include <Eigen/Geometry>

#include <assembly/body.h>

using namespace sherd;
using namespace sherd::test;

namespace
{

/// Elements, on all ranks together, that turn from the reference position to @p positions.
template <class Model>
int n_turned(const ModelBody<Model> &body, const Eigen::MatrixXd &positions)
{
  auto       global = gather(body.state, body.space);
  const auto before = body.state.position;
  global.position   = positions;
  int n             = body.assembler.n_turned(before, distribute(global, body.space).position);
  MPI_Allreduce(MPI_IN_PLACE, &n, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  return n;
}

} // namespace

TEST_CASE("Elements that turn inside out are found")
{
  const Body            body(MPI_COMM_WORLD, crowded_plate());
  const Eigen::MatrixXd X = body.surface.control_points();

  // Squeezed to J = 1e-6, stretched, rotated by less than a right angle: det F > 0.
  CHECK(n_turned(body, X * 1e-3) == 0);
  CHECK(n_turned(body, X * 10.) == 0);
  CHECK(n_turned(body, X * Eigen::Rotation2Dd(1.5).toRotationMatrix().transpose()) == 0);

  // det F < 0 everywhere, with the metric of the undeformed plate.
  CHECK(n_turned(body, X * Eigen::DiagonalMatrix<double, 2>(-1., 1.).toDenseMatrix()) == body.surface.n_elements());

  // One control point, dragged across its neighbours, turns elements it carries and no others.
  Eigen::MatrixXd dragged = X;
  const int       point   = body.surface.n_control_points() / 2;
  dragged.row(point) += Eigen::RowVector2d(30., 0.);
  int n_carried = 0;
  for (int e = 0; e < body.surface.n_elements(); ++e)
    {
      const auto points = element_data(body.model, body.surface, e).geometry.points;
      n_carried += std::find(points.begin(), points.end(), point) != points.end();
    }
  CHECK(n_turned(body, dragged) > 0);
  CHECK(n_turned(body, dragged) <= n_carried);
}

TEST_CASE("A shell that rotates in space does not turn inside out, one that is mirrored in its plane does")
{
  const ModelBody<Shell> body(MPI_COMM_WORLD, shapes::plate<2, 3>({4., 2.}, {4, 2}), shell());
  const Eigen::MatrixXd  X    = body.surface.control_points();
  const Eigen::Matrix3d  turn = Eigen::AngleAxisd(1.5, Eigen::Vector3d(1., 2., 3.).normalized()).toRotationMatrix();
  CHECK(n_turned(body, X * turn.transpose()) == 0);
  CHECK(n_turned(body, X * Eigen::DiagonalMatrix<double, 3>(-1., 1., 1.).toDenseMatrix()) == 8);
}
