/// Mistakes in a job, kept as they are found, so that one reading tells them all.
///
/// A mistake ends one step of the reading of its section; steps that do not need each
/// other are all taken (`Section::attempt_all`), and what needs a value that could not be
/// read is no mistake of its own (`Follows`). A section with a mistake is not read; what
/// refers to it follows from that, and what needs all of a building is not asked of a
/// part of one.
#pragma once

#include "base/error.hpp"
#include "schema/document.hpp"

#include <set>
#include <string>
#include <vector>

namespace bemcal::schema {

/// Thrown where something cannot be read because of a mistake that is known already.
class Follows : public UserError {
  public:
    Follows() : UserError(ExitCode::config, "follows from another mistake") {}
};

class Mistakes {
  public:
    /// Does the work and keeps its UserError. \return whether it went well
    template <class Work>
    bool keep(Work work) {
        try {
            work();
            return true;
        } catch (const Follows&) {
            ++n_failures_;
        } catch (const UserError& error) {
            add(error);
        }
        return false;
    }
    /// One that is told already is not told again.
    void add(const UserError& error);

    /// It is not read: its keys are not without effect, and its names stand for nothing.
    void lose(const Node& node);
    /// A name; or a kind, such as "zone", of which any may be meant.
    void lose(const std::string& name) {
        if (!name.empty()) lost_.insert(name);
    }
    /// Whether a name, or a path such as "zone.office.flow", may stand for what was not
    /// read: any of its words is lost, be it a name or a kind.
    bool is_lost(const std::string& path) const;

    /// Rises with whatever could not be read.
    std::size_t n_failures() const { return n_failures_; }
    /// Throws all of them as one UserError, with the exit code of the first that was
    /// found: those of `file` first, then by file and line. Nothing where there is none.
    void throw_all(const std::string& file) const;

  private:
    std::vector<UserError> errors_;
    std::set<std::string> lost_;
    std::size_t n_failures_ = 0;
};

}  // namespace bemcal::schema
