#pragma once
#include <map>
#include <string>

#include "engine/fields/projection.h"
#include "engine/results/result.h"
#include "engine/solid/bulk_term.h"

namespace burnish::inline fields {

/// Fields of the accepted state at the quadrature points of the body's portion, components x points:
///   stress      Cauchy σ = τ/J, components xx yy xy zz (2D) or xx yy zz xy yz zx
///   von_mises   from σ
///   pressure    −⅓ tr σ, all three normal components
/// and those of the material law, such as plastic_strain.
template <int Dim>
std::map<std::string, FieldRecord> quadratureFields(const BulkTerm<Dim>& bulk, const std::string& stressUnit);

/// Fields at all quadrature points from those of each rank's portion; to be called by all ranks. A rank that is
/// not to have them has none.
std::map<std::string, FieldRecord> whole(const Portion& portion, std::map<std::string, FieldRecord> fields,
                                         Receivers receivers);

/// Fields at all quadrature points projected: coefficients, components x nodes.
template <int Dim>
std::map<std::string, FieldRecord> projected(const Projection<Dim>& projection,
                                             std::map<std::string, FieldRecord> fields);

}  // namespace burnish::inline fields
