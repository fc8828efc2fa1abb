// Our numbers against an independent trace of the same prescriptions: the "recomputed" values of the shared
// collection, which lie beside the checkout and not in it.
#include "lens_files/readers.h"
#include "optics/aberrations.h"
#include "optics/seidel.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

namespace petzval::lens_files {
namespace {

struct Reference {
    optics::Prescription lens;
    optics::FirstOrder first;
    double field_deg = 0;
    Json values;  // "recomputed"
};

class ReferenceValues : public testing::Test {
protected:
    void SetUp() override {
        const std::filesystem::path path(PETZVAL_SOURCE_DIR "/../shared/optics/lenses.json");
        std::ifstream stream(path, std::ios::binary);
        if (!stream) GTEST_SKIP() << path << " is not there";
        const std::string text((std::istreambuf_iterator<char>(stream)), {});
        const Json json = parse_json(text).value();
        for (const Json& entry : json.find("lenses")->items) {
            Reference reference;
            reference.lens = read_json_lens(entry).value().lens;
            reference.first = optics::first_order(reference.lens, reference.lens.primary_um).value();
            reference.field_deg = optics::seidel_field_deg(reference.lens, reference.first);
            reference.values = *entry.find("recomputed");
            references_.push_back(std::move(reference));
        }
        ASSERT_GE(references_.size(), 31u);
    }

    std::vector<Reference> references_;
};

void expect_relative(double ours, const Json& value, double relative, const std::string& what) {
    EXPECT_NEAR(ours, value.number, relative * std::abs(value.number) + 1e-11) << what;
}

TEST_F(ReferenceValues, FirstOrderAgreesToTheLastDigit) {
    for (const Reference& r : references_) {
        SCOPED_TRACE(r.lens.id);
        const auto& f = r.first;
        const std::pair<const char*, double> values[] = {
            {"EFL", f.focal_length_mm},
            {"BFL", f.back_focal_length_mm},
            {"FFL_from_first_vertex", f.front_focal_position_mm},
            {"f_number", f.f_number},
            {"EPD", f.entrance_pupil_diameter_mm},
            {"EPL_from_first_vertex", f.entrance_pupil_position_mm},
            {"XPL_from_last_vertex", f.exit_pupil_position_mm},
            {"XPD", f.exit_pupil_diameter_mm},
            {"vertex_length", f.vertex_length_mm},
            {"petzval_radius", f.petzval_radius_mm}};
        for (const auto& [name, ours] : values) expect_relative(ours, *r.values.find(name), 5.1e-9, name);
        if (const Json* lines = r.values.find("paraxial_by_wavelength"))
            for (const auto& [um, line] : lines->members) {
                // Keys are rounded to four decimals; the file's lines are g, F, d, C or the lens's own.
                double w = *parse_number(um);
                for (const double exact :
                     {r.lens.short_um, r.lens.primary_um, r.lens.long_um, optics::kLineG_um})
                    if (std::abs(exact - w) < 6e-5) w = exact;
                expect_relative(optics::first_order(r.lens, w)->back_focal_length_mm, *line.find("BFL"),
                                5.1e-9, um);
            }
    }
}

TEST_F(ReferenceValues, SeidelSumsAgreeSurfaceBySurface) {
    using S = optics::SeidelSums;
    const std::pair<const char*, double S::*> names[] = {
        {"S_I", &S::s1}, {"S_II", &S::s2}, {"S_III", &S::s3}, {"S_IV", &S::s4},
        {"S_V", &S::s5}, {"C_I", &S::c1},  {"C_II", &S::c2}};
    int tables = 0;
    for (const Reference& r : references_) {
        SCOPED_TRACE(r.lens.id);
        const auto table = optics::seidel(r.lens, r.first, r.field_deg);
        expect_relative(table.lagrange_invariant_mm, *r.values.find("lagrange_invariant"), 5.1e-9, "H");
        const Json* sum = r.values.find("seidel_sum");
        if (!sum) continue;
        ++tables;
        for (const auto& [name, member] : names)
            if (const Json* value = sum->find(name)) expect_relative(table.sum.*member, *value, 6e-7, name);
        const Json& rows = *r.values.find("seidel_per_surface");
        for (std::size_t i = 0; i < rows.items.size(); ++i)
            for (std::size_t k = 0; k < rows.items[i].items.size(); ++k)
                expect_relative(table.surfaces[i].*names[k].second, rows.items[i].items[k], 6e-6,
                                names[k].first);
    }
    EXPECT_GE(tables, 29);
}

TEST_F(ReferenceValues, LongitudinalAberrationAgreesAtEveryZoneAndWavelength) {
    for (const Reference& r : references_) {
        SCOPED_TRACE(r.lens.id);
        const Json& stored = *r.values.find("longitudinal_aberration");
        std::vector<double> zones;
        for (const Json& zone : stored.find("pupil_zone")->items) zones.push_back(zone.number);
        for (const auto& [um, shifts] : stored.find("axis_crossing_minus_primary_paraxial_focus")->members) {
            double w = *parse_number(um);
            for (const double exact : {r.lens.short_um, r.lens.primary_um, r.lens.long_um, optics::kLineG_um})
                if (std::abs(exact - w) < 6e-5) w = exact;
            const auto ours = optics::longitudinal_aberration(r.lens, r.first, std::vector{w}, zones);
            for (std::size_t k = 0; k < zones.size(); ++k)
                EXPECT_NEAR(ours.shift_mm[0][k], shifts.items[k].number,
                            6e-6 * std::abs(shifts.items[k].number) + 1e-8)
                    << um << " zone " << zones[k];
        }
    }
}

TEST_F(ReferenceValues, UnaimedRealRaysAgreeToNineDecimals) {
    int rays = 0;
    for (const Reference& r : references_) {
        SCOPED_TRACE(r.lens.id);
        const Json& stored = *r.values.find("real_rays");
        const double plane = stored.find("image_plane_from_last_vertex")->number;
        const auto at = optics::at_wavelength(r.lens, r.lens.primary_um);
        for (const Json& row : stored.find("rows")->items) {
            const auto value = [&](std::size_t k) { return row.items[k].number; };
            const auto end = optics::trace(
                at, optics::paraxial_pupil_ray(r.lens, r.first, value(0) * r.field_deg, value(1), value(2)));
            ASSERT_EQ(end.fate, optics::RayFate::Passed);
            // The stored plane has nine digits.
            const optics::Vec3& d = end.ray.direction;
            const double doubt = 1e-9 + 5.1e-9 * plane * std::hypot(d.x, d.y) / d.z;
            const optics::Vec3 landing = optics::at_plane(end.ray, plane);
            EXPECT_NEAR(landing.x, value(3), doubt);
            EXPECT_NEAR(landing.y, value(4), doubt);
            EXPECT_NEAR(end.ray.direction.x, value(5), 6e-10);
            EXPECT_NEAR(end.ray.direction.y, value(6), 6e-10);
            ++rays;
        }
    }
    EXPECT_GE(rays, 31 * 3);
}

// Share of the paraxial pupil's neighbourhood that reaches the image with every rim acting, the stop's as
// listed.
double beam_area(const Reference& r, double field_deg) {
    auto at = optics::at_wavelength(r.lens, r.lens.primary_um);
    at.stop = -1;  // no rim is excepted
    const int across = 121;
    int passed = 0;
    for (int iy = 0; iy < across; ++iy)
        for (int ix = 0; ix < across; ++ix) {
            const double px = 2.2 * ((ix + 0.5) / across * 2 - 1), py = 2.2 * ((iy + 0.5) / across * 2 - 1);
            const auto end =
                optics::trace(at, optics::paraxial_pupil_ray(r.lens, r.first, field_deg, px, py));
            passed += end.fate == optics::RayFate::Passed && end.clearance <= 1;
        }
    return passed;
}

TEST_F(ReferenceValues, VignettingAreaRatiosAgree) {
    int ratios = 0;
    for (const Reference& r : references_) {
        const Json* stored = r.values.find("unvignetted_beam_area_ratio");
        if (!stored) continue;
        const double axis = beam_area(r, 0);
        for (const auto& [field, ratio] : stored->find("by_relative_field")->members) {
            EXPECT_NEAR(beam_area(r, *parse_number(field) * r.field_deg) / axis, ratio.number, 0.012)
                << r.lens.id << " at " << field;
            ++ratios;
        }
    }
    EXPECT_GE(ratios, 80);
}

}  // namespace
}  // namespace petzval::lens_files
