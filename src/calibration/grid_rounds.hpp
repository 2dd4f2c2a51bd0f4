/// What a stage of a grid shows, and the grid of the next one.
#pragma once

#include "calibration/grid_axes.hpp"
#include "calibration/grid_options.hpp"
#include "physics/parameters.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bemcal::calibration {

/// Every parameter of the simulator with its values: those given, else the nominal one.
Grid grid_of(const std::vector<physics::Parameter>& parameters, const NamedGrid& named);

/// What became of a parameter in a stage.
enum class ParameterRole {
    held,        ///< it had one value from the start
    open,        ///< several values survive
    determined,  ///< one value survives, and it matters: fixed
    insensitive  ///< one value survives, and it does not matter: fixed
};
const char* words_of(ParameterRole role);

/// A stage with its answers. Indices of points are those of its grid.
struct GridStage {
    Grid grid;
    std::size_t first_point = 0;       ///< in the study
    Matrix outputs;                    ///< [points x targets]; NaN = failed
    Matrix errors;                     ///< of them [%]
    std::vector<double> distance;      ///< [points] to the reference point; NaN = failed
    stats::Selection selection;        ///< with density avoidance
    std::vector<std::size_t> plain;    ///< the plain nearest, as many
    Grid surviving;                    ///< values that the selected have [parameters]
    Matrix total_order;                ///< [targets + 1 x parameters], last the distance
    std::vector<ParameterRole> roles;  ///< [parameters]

    bool has_answer() const { return !plain.empty(); }
    std::size_t nearest() const { return plain.at(0); }
    double error(std::size_t point) const;  ///< Euclidean [%]
};

/// A study as it stands after its last answered stage.
class GridRounds {
  public:
    GridRounds(std::vector<physics::Parameter> parameters, GridOptions options);

    const std::vector<physics::Parameter>& parameters() const { return parameters_; }
    const GridOptions& options() const { return options_; }
    const std::vector<GridStage>& stages() const { return stages_; }
    const std::vector<double>& scales() const { return scales_; }  ///< [targets]

    Grid first_grid() const { return grid_of(parameters_, options_.grids.at(0)); }
    /// \param outputs  [points x targets], NaN = failed
    void add(Grid grid, Matrix outputs);

    struct Next {
        std::optional<Grid> grid;  ///< none: the study ends, ...
        std::string reason;        ///< ... and why
    };
    Next next() const;

    std::size_t n_points() const;
    /// The stage with the nearest point of all; none where every point failed.
    const GridStage* best() const;

  private:
    void measure(GridStage& stage);
    void select(GridStage& stage) const;
    void judge(GridStage& stage) const;
    std::optional<Grid> refined() const;
    Grid refined_by(std::size_t n_kept, const std::vector<char>& is_free) const;
    std::vector<char> set_free() const;
    bool has_stalled() const;

    std::vector<physics::Parameter> parameters_;
    GridOptions options_;
    std::vector<GridStage> stages_;
    std::vector<double> scales_;
};

}  // namespace bemcal::calibration
