#pragma once

#include <sherd/base/types.h>
#include <sherd/forms/dense_product.h>
#include <sherd/forms/unknowns.h>
#include <sherd/geometry/shape_values.h>

namespace sherd
{

/// Bernstein coefficients of the fields of one element, index order [component][b].
template <class Model>
struct ElementFields
{
  static constexpr int n_b = ShapeValues<Model::degree>::n_functions;

  alignas(64) double position[Model::spacedim][n_b];     ///< x at the level of the balance of momentum
  alignas(64) double acceleration[Model::spacedim][n_b]; ///< a at its level, [length/time^2]
  alignas(64) double phase[n_b];                         ///< phi at its level
};

/// Element vector in Bernstein form, index order [field][b]; the fields are the displacements, then the phase.
template <class Model>
struct ElementVector
{
  static constexpr int n_b = ShapeValues<Model::degree>::n_functions;

  alignas(64) double value[Model::n_fields][n_b];
};

/// Element matrix of a part of the unknowns in Bernstein form: row field*n_b + b with fields counted from the first of
/// the part, column likewise. Columns are padded to whole vector registers; the padding holds zeros.
template <class Model, Unknowns part = Unknowns::all>
struct ElementMatrix
{
  static constexpr FieldRange fields = fields_of(part, Model::spacedim);

  static constexpr int n_b    = ShapeValues<Model::degree>::n_functions;
  static constexpr int size   = fields.count * n_b;
  static constexpr int stride = (size + 7) / 8 * 8;

  alignas(64) double value[size][stride];
};

} // namespace sherd
