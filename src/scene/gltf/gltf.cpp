#include "scene/gltf/gltf.h"

#include "scene/gltf/lights.h"
#ifdef PETZVAL_GLTF
#include "base/whole_file.h"
#include "scene/gltf/animation.h"
#include "scene/gltf/numbers.h"
#endif

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <utility>

namespace petzval::scene {

bool is_gltf(const std::string& name) { return name.ends_with(".gltf") || name.ends_with(".glb"); }

#ifndef PETZVAL_GLTF

Result<GltfScene> add_gltf(World&, const std::string& path, int, const std::string&) {
    return Error{ErrorCode::Unsupported,
                 path + ": this petzval was built without glTF; install libtinygltf-dev and build again"};
}

#else

namespace {

constexpr int kDeepest = 64;  // nodes below nodes: more is a ring
constexpr std::size_t kMostTriangles = 20'000'000;

// Rows of a matrix for column vectors.
struct Matrix {
    std::array<double, 16> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

    Matrix operator*(const Matrix& b) const {
        Matrix product;
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 4; ++j) {
                double sum = 0;
                for (std::size_t k = 0; k < 4; ++k) sum += m[4 * i + k] * b.m[4 * k + j];
                product.m[4 * i + j] = sum;
            }
        return product;
    }
    // Converts to petzval's world, where z points away.
    Vec3 point(double x, double y, double z) const { return turned(x, y, z, 1); }
    Vec3 direction(double x, double y, double z) const { return turned(x, y, z, 0); }
    // A normal: by the matrix of cofactors, which is right for any scale.
    Vec3 normal(double x, double y, double z) const {
        const auto c = [&](std::size_t i, std::size_t j) {
            const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, p = (j + 1) % 3, q = (j + 2) % 3;
            return m[4 * a + p] * m[4 * b + q] - m[4 * a + q] * m[4 * b + p];
        };
        return normalised({float(c(0, 0) * x + c(0, 1) * y + c(0, 2) * z),
                           float(c(1, 0) * x + c(1, 1) * y + c(1, 2) * z),
                           -float(c(2, 0) * x + c(2, 1) * y + c(2, 2) * z)});
    }

private:
    Vec3 turned(double x, double y, double z, double w) const {
        return {float(m[0] * x + m[1] * y + m[2] * z + m[3] * w),
                float(m[4] * x + m[5] * y + m[6] * z + m[7] * w),
                -float(m[8] * x + m[9] * y + m[10] * z + m[11] * w)};
    }
};

Matrix matrix_of(const tinygltf::Node& node) {
    Matrix all;
    if (node.matrix.size() == 16) {
        for (std::size_t i = 0; i < 16; ++i) all.m[4 * (i % 4) + i / 4] = node.matrix[i];
        return all;
    }
    const auto& q = node.rotation;
    if (q.size() == 4) {
        const double x = q[0], y = q[1], z = q[2], w = q[3];
        all.m = {1 - 2 * (y * y + z * z),
                 2 * (x * y - z * w),
                 2 * (x * z + y * w),
                 0,
                 2 * (x * y + z * w),
                 1 - 2 * (x * x + z * z),
                 2 * (y * z - x * w),
                 0,
                 2 * (x * z - y * w),
                 2 * (y * z + x * w),
                 1 - 2 * (x * x + y * y),
                 0,
                 0,
                 0,
                 0,
                 1};
    }
    for (std::size_t j = 0; j < 3 && node.scale.size() == 3; ++j)
        for (std::size_t i = 0; i < 3; ++i) all.m[4 * i + j] *= node.scale[j];
    for (std::size_t i = 0; i < 3 && node.translation.size() == 3; ++i)
        all.m[4 * i + 3] = node.translation[i];
    return all;
}

// A picture as light, 0…1, repeated without end.
struct Texels {
    int width = 0, height = 0;
    std::vector<std::array<float, 4>> rgba;

    std::array<float, 4> at(float u, float v) const {
        const auto place = [](float share, int size) {
            const float inside = share - std::floor(share);
            return std::clamp(int(inside * float(size)), 0, size - 1);
        };
        if (!std::isfinite(u) || !std::isfinite(v)) return {1, 1, 1, 1};
        return rgba[std::size_t(place(v, height)) * std::size_t(width) + std::size_t(place(u, width))];
    }
};

struct Surface {
    std::array<float, 4> base{1, 1, 1, 1};
    Vec3 emission;
    std::shared_ptr<const Texels> texture, glow;  // null: none
    bool has_holes = false;
    float cutoff = 0.5f;
};

class Reader {
public:
    Reader(World& world, const tinygltf::Model& model, std::string path, std::vector<std::string>& warnings)
        : world_(world), model_(model), path_(std::move(path)), warnings_(warnings) {}

    Status read() {
        world_.is_baked = false;
        if (model_.scenes.empty()) return broken("no scene");
        const std::size_t scene = std::size_t(std::max(0, model_.defaultScene));
        if (scene >= model_.scenes.size()) return broken("no such scene as its default");
        for (const int node : model_.scenes[scene].nodes)
            if (Status done = visit(node, Matrix{}, 0); !done) return done;
        if (triangles_ == 0) return broken("no triangles");
        const float dimmed = lighting_->settle(world_, 0.5f * (low_ + high_), path_, warnings_);
        for (auto& [mesh, surface] : meshes_) {
            surface.emission *= dimmed;
            world_.add(std::move(mesh), paint(surface), Sides::Leaf, holes(surface));
        }
        return Done{};
    }

    // `wanted`: a name, or a number from 1; empty: the first.
    Status place_camera(const std::string& wanted, Camera& camera) const {
        const Vec3 middle = 0.5f * (low_ + high_);
        const float reach = std::max(0.5f * length(high_ - low_), 1e-4f);
        camera = {.focal_length_mm = 50, .sensor_width_mm = 36, .f_number = 2, .focus_distance_m = 1};
        if (!cameras_.empty() || !wanted.empty()) {
            const auto own = camera_called(wanted);
            if (!own) return own.error();
            world_.view = own->view;
            camera.focal_length_mm = own->focal_length_mm;
        } else {
            const float far = 2.2f * reach * float(camera.focal_length_mm) / (36 * 9.0f / 16);
            world_.view = Viewpoint::looking(middle - normalised(Vec3{-0.35f, -0.25f, 1}) * far, middle);
        }
        const double ahead = double(world_.view.from_world(middle).z);
        camera.focus_distance_m = ahead > 0 ? ahead : double(reach);
        return Done{};
    }

    std::vector<std::string> camera_names() const {
        std::vector<std::string> names;
        for (const OwnCamera& one : cameras_) names.push_back(one.name);
        return names;
    }

private:
    Error broken(const std::string& why) const { return {ErrorCode::InvalidFile, path_ + ": " + why}; }

    struct OwnCamera {
        std::string name;
        Viewpoint view;
        double focal_length_mm = 50;
    };

    Result<OwnCamera> camera_called(const std::string& wanted) const {
        std::size_t number = wanted.empty() ? 1 : 0;
        std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
        std::string known;
        for (const OwnCamera& one : cameras_) {
            if (one.name == wanted) return one;
            known += (known.empty() ? "" : ", ") + one.name;
        }
        if (number >= 1 && number <= cameras_.size()) return cameras_[number - 1];
        return Error{ErrorCode::InvalidArgument,
                     "scene.own_camera " + wanted + ": " + path_ + " has no such camera" +
                         (known.empty() ? "" : "; it has " + known),
                     "scene.own_camera"};
    }

    template <typename List>
    static bool has(const List& list, int index) {
        return index >= 0 && std::size_t(index) < list.size();
    }

    Result<GltfNumbers> numbers(int index, int kind) const {
        return gltf_numbers(model_, index, kind, path_);
    }

    Status visit(int index, const Matrix& above, int depth) {
        if (!has(model_.nodes, index)) return broken("a node is missing");
        if (depth > kDeepest || ++visited_ > 1'000'000)
            return broken("its nodes form a ring, or are too many");
        const tinygltf::Node& node = model_.nodes[std::size_t(index)];
        const Matrix here = above * matrix_of(node);
        if (node.camera >= 0) take_camera(node, here);
        take_light(node, here);
        if (node.mesh >= 0) {
            if (!has(model_.meshes, node.mesh)) return broken("a mesh is missing");
            for (const tinygltf::Primitive& part : model_.meshes[std::size_t(node.mesh)].primitives)
                if (part.mode == TINYGLTF_MODE_TRIANGLES || part.mode == -1)
                    if (Status done = take_part(part, here); !done) return done;
        }
        for (const int child : node.children)
            if (Status done = visit(child, here, depth + 1); !done) return done;
        return Done{};
    }

    void take_camera(const tinygltf::Node& node, const Matrix& here) {
        if (!has(model_.cameras, node.camera)) return;
        const tinygltf::Camera& camera = model_.cameras[std::size_t(node.camera)];
        if (camera.type != "perspective" || !(camera.perspective.yfov > 0.01 && camera.perspective.yfov < 3))
            return;
        const Viewpoint view{here.point(0, 0, 0), normalised(here.direction(1, 0, 0)),
                             normalised(here.direction(0, 1, 0)), normalised(here.direction(0, 0, -1))};
        if (!is_somewhere(view.position) || !is_somewhere(view.right + view.up + view.forward)) return;
        std::string name = node.name.empty() ? camera.name : node.name;
        if (name.empty()) name = std::to_string(cameras_.size() + 1);
        cameras_.push_back({name, view, 0.5 * 36 * 9 / 16 / std::tan(0.5 * camera.perspective.yfov)});
    }

    void take_light(const tinygltf::Node& node, const Matrix& here) {
        const auto found = node.extensions.find("KHR_lights_punctual");
        if (found == node.extensions.end() || !found->second.Has("light")) return;
        const int index = found->second.Get("light").GetNumberAsInt();
        if (!has(model_.lights, index)) return;
        const tinygltf::Light& light = model_.lights[std::size_t(index)];
        PunctualLight taken;
        taken.light.distant = light.type == "directional";
        taken.axis = normalised(here.direction(0, 0, -1));
        taken.light.position = taken.light.distant ? -taken.axis : here.point(0, 0, 0);
        const auto shade = [&](std::size_t k) { return light.color.size() > k ? light.color[k] : 1.0; };
        taken.light.power = float(light.intensity) * Vec3{float(shade(0)), float(shade(1)), float(shade(2))};
        if (light.type == "spot") {
            taken.cos_inner = float(std::cos(light.spot.innerConeAngle));
            taken.cos_outer = float(std::cos(light.spot.outerConeAngle));
        }
        const Vec3 all = taken.light.power + taken.light.position;
        const bool is_known = light.type == "directional" || light.type == "point" || light.type == "spot";
        if (is_known && luminance(taken.light.power) > 0 && std::isfinite(dot(all, all)))
            lighting_->lights.push_back(taken);
    }

    Status take_part(const tinygltf::Primitive& part, const Matrix& here) {
        const auto attribute = [&](const char* name) {
            const auto found = part.attributes.find(name);
            return found == part.attributes.end() ? -1 : found->second;
        };
        const auto places = numbers(attribute("POSITION"), TINYGLTF_TYPE_VEC3);
        if (!places) return places.error();
        if (places->type != TINYGLTF_COMPONENT_TYPE_FLOAT) return broken("positions that are not floats");
        Mesh mesh;
        for (std::size_t i = 0; i < places->count; ++i) {
            const Vec3 p = here.point(places->at(i, 0), places->at(i, 1), places->at(i, 2));
            if (!is_somewhere(p)) return broken("a vertex that is not finite");
            mesh.positions.push_back(p);
        }
        if (Status done = take_triangles(part.indices, mesh); !done) return done;
        if (Status done = take_normals(attribute("NORMAL"), here, mesh); !done) return done;
        if (Status done = take_uv(attribute("TEXCOORD_0"), mesh); !done) return done;
        for (const Vec3 p : mesh.positions) {
            low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z)};
            high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y), std::max(high_.z, p.z)};
        }
        meshes_.emplace_back(std::move(mesh), surface_of(part.material));
        return Done{};
    }

    Status take_triangles(int index, Mesh& mesh) {
        std::vector<std::uint32_t> order;
        if (index >= 0) {
            const auto all = numbers(index, TINYGLTF_TYPE_SCALAR);
            if (!all) return all.error();
            if (all->type == TINYGLTF_COMPONENT_TYPE_FLOAT)
                return broken("indices that are not whole numbers");
            for (std::size_t i = 0; i < all->count; ++i) {
                const double vertex = all->at(i, 0);
                if (vertex < 0 || vertex >= double(mesh.positions.size()))
                    return broken("a triangle of vertices that do not exist");
                order.push_back(std::uint32_t(vertex));
            }
        } else {
            for (std::size_t i = 0; i < mesh.positions.size(); ++i) order.push_back(std::uint32_t(i));
        }
        for (std::size_t i = 0; i + 2 < order.size(); i += 3)
            mesh.triangles.push_back({order[i], order[i + 1], order[i + 2]});
        triangles_ += mesh.triangles.size();
        if (triangles_ > kMostTriangles) return broken("more than 20 million triangles");
        if (mesh.triangles.empty()) return broken("a mesh without triangles");
        return Done{};
    }

    Status take_normals(int index, const Matrix& here, Mesh& mesh) {
        mesh.normals.resize(mesh.positions.size());
        if (index < 0) {  // those of the triangles around, by their areas
            for (const auto& t : mesh.triangles) {
                const auto& p = mesh.positions;
                const Vec3 flat = cross(p[t[2]] - p[t[0]], p[t[1]] - p[t[0]]);
                for (const std::uint32_t v : t) mesh.normals[v] += flat;
            }
            for (Vec3& n : mesh.normals) n = dot(n, n) > 0 ? normalised(n) : Vec3{0, 1, 0};
            return Done{};
        }
        const auto all = numbers(index, TINYGLTF_TYPE_VEC3);
        if (!all) return all.error();
        if (all->count < mesh.positions.size() || all->type != TINYGLTF_COMPONENT_TYPE_FLOAT)
            return broken("fewer normals than vertices, or no floats");
        for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
            const Vec3 n = here.normal(all->at(i, 0), all->at(i, 1), all->at(i, 2));
            mesh.normals[i] = std::isfinite(dot(n, n)) ? n : Vec3{0, 1, 0};
        }
        return Done{};
    }

    Status take_uv(int index, Mesh& mesh) {
        mesh.uv.assign(mesh.positions.size(), {0, 0});
        if (index < 0) return Done{};
        const auto all = numbers(index, TINYGLTF_TYPE_VEC2);
        if (!all) return all.error();
        if (all->count < mesh.uv.size()) return broken("fewer texture coordinates than vertices");
        for (std::size_t i = 0; i < mesh.uv.size(); ++i)
            mesh.uv[i] = {float(all->at(i, 0)), float(all->at(i, 1))};
        return Done{};
    }

    Surface surface_of(int index) {
        Surface surface;
        if (!has(model_.materials, index)) return surface;
        const tinygltf::Material& m = model_.materials[std::size_t(index)];
        const auto& base = m.pbrMetallicRoughness.baseColorFactor;
        for (std::size_t k = 0; k < 4 && base.size() == 4; ++k)
            surface.base[k] = float(std::clamp(base[k], 0.0, 1.0));
        if (m.emissiveFactor.size() == 3)
            surface.emission = {float(m.emissiveFactor[0]), float(m.emissiveFactor[1]),
                                float(m.emissiveFactor[2])};
        const auto strength = m.extensions.find("KHR_materials_emissive_strength");
        if (strength != m.extensions.end() && strength->second.Has("emissiveStrength"))
            surface.emission *= float(strength->second.Get("emissiveStrength").GetNumberAsDouble());
        surface.texture = texels(m.pbrMetallicRoughness.baseColorTexture.index);
        surface.glow = texels(m.emissiveTexture.index);
        surface.has_holes = m.alphaMode != "OPAQUE";
        surface.cutoff = m.alphaMode == "MASK" ? float(m.alphaCutoff) : 0.5f;
        return surface;
    }

    std::shared_ptr<const Texels> texels(int index) {
        if (!has(model_.textures, index)) return nullptr;
        const int source = model_.textures[std::size_t(index)].source;
        if (!has(model_.images, source)) return nullptr;
        auto& kept = pictures_[source];
        if (kept) return kept;
        const tinygltf::Image& image = model_.images[std::size_t(source)];
        const std::size_t count =
            std::size_t(std::max(0, image.width)) * std::size_t(std::max(0, image.height));
        if (count == 0 || image.bits != 8 || image.component != 4 || image.image.size() < 4 * count)
            return nullptr;
        auto made = std::make_shared<Texels>(Texels{image.width, image.height, {}});
        made->rgba.resize(count);
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t k = 0; k < 4; ++k) {
                const float code = float(image.image[4 * i + k]) / 255;
                made->rgba[i][k] = k == 3             ? code
                                   : code <= 0.04045f ? code / 12.92f
                                                      : std::pow((code + 0.055f) / 1.055f, 2.4f);
            }
        return kept = std::move(made);
    }

    Paint paint(const Surface& of) const {
        return [world = &world_, lighting = lighting_, of](const SurfacePoint& p) {
            const auto t = of.texture ? of.texture->at(p.u, p.v) : std::array<float, 4>{1, 1, 1, 1};
            const auto g = of.glow ? of.glow->at(p.u, p.v) : std::array<float, 4>{1, 1, 1, 1};
            const Vec3 albedo{of.base[0] * t[0], of.base[1] * t[1], of.base[2] * t[2]};
            const Vec3 light = lighting->on(*world, p, albedo) + of.emission * Vec3{g[0], g[1], g[2]};
            return Matter{{}, light};
        };
    }
    static Cutout holes(const Surface& of) {
        if (!of.has_holes) return nullptr;
        return [of](float u, float v) {
            return of.base[3] * (of.texture ? of.texture->at(u, v)[3] : 1) >= of.cutoff;
        };
    }

    World& world_;
    const tinygltf::Model& model_;
    std::string path_;
    std::vector<std::string>& warnings_;
    std::vector<std::pair<Mesh, Surface>> meshes_;
    std::map<int, std::shared_ptr<const Texels>> pictures_;
    std::vector<OwnCamera> cameras_;
    std::shared_ptr<Lighting> lighting_ = std::make_shared<Lighting>();
    Vec3 low_{1e12f, 1e12f, 1e12f}, high_{-1e12f, -1e12f, -1e12f};
    std::size_t triangles_ = 0, visited_ = 0;
};

// The first line of a reader's message.
std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

// A pipe would be waited for; a glTF names others.
bool is_file(const std::string& path, void*) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
}
// tinygltf's own reader takes what a failing disk leaves out for zeros. failed: std::optional<Error>, of the
// first file that the system did not read.
bool read_file(std::vector<unsigned char>* bytes, std::string* wrong, const std::string& path, void* failed) {
    constexpr std::size_t kMost = std::size_t(1) << 32;
    const auto refuse = [&](const std::string& why) {
        if (wrong) *wrong += path + why + "\n";
        return false;
    };
    if (!is_file(path, failed)) return refuse(" is missing, or is not a regular file");
    const auto text = text_of_file(path, kMost);
    auto& first = *static_cast<std::optional<Error>*>(failed);
    if (!text && text.error().code == ErrorCode::ReadFailed && !first) first = text.error();
    if (!text) return refuse(" cannot be read");
    if (text->size() > kMost) return refuse(" is longer than 4 GiB");
    bytes->assign(text->begin(), text->end());
    return true;
}

Status load(const std::string& path, tinygltf::Model& model, std::vector<std::string>& warnings) {
    tinygltf::TinyGLTF loader;
    std::optional<Error> failed;
    loader.SetFsCallbacks(
        {&is_file, &tinygltf::ExpandFilePath, &read_file, &tinygltf::WriteWholeFile, &failed});
    std::string wrong, warning;
    const bool fine = path.ends_with(".glb") ? loader.LoadBinaryFromFile(&model, &wrong, &warning, path)
                                             : loader.LoadASCIIFromFile(&model, &wrong, &warning, path);
    if (failed) return *failed;
    // tinygltf catches what its JSON parser throws and passes on the words alone.
    if (!fine && wrong.starts_with(std::bad_alloc().what())) throw std::bad_alloc();
    if (!fine)
        return Error{ErrorCode::InvalidFile, path + ": not a glTF file that can be read" +
                                                 (wrong.empty() ? "" : ": " + first_line(wrong))};
    if (!warning.empty()) warnings.push_back(path + ": " + first_line(warning));
    const auto& needed = model.extensionsRequired;
    const auto unread = std::find_if_not(needed.begin(), needed.end(), [](const std::string& name) {
        return name == "KHR_lights_punctual" || name == "KHR_materials_emissive_strength" ||
               name == "KHR_texture_transform" || name == "KHR_materials_unlit";
    });
    if (unread != needed.end())
        return Error{ErrorCode::InvalidFile, path + ": needs " + *unread + ", which is not read"};
    return Done{};
}

}  // namespace

Result<GltfScene> add_gltf(World& world, const std::string& path, int frame, const std::string& camera) {
    try {
        GltfScene scene;
        tinygltf::Model model;
        if (Status done = load(path, model, scene.warnings); !done) return done.error();
        const auto seconds = pose(model, double(frame) / kGltfFramesPerSecond, path, scene.warnings);
        if (!seconds) return seconds.error();
        scene.frames = 1 + int(std::ceil(*seconds * kGltfFramesPerSecond - 1e-6));
        Reader reader(world, model, path, scene.warnings);
        if (Status done = reader.read(); !done) return done.error();
        if (Status done = reader.place_camera(camera, scene.camera); !done) return done.error();
        scene.cameras = reader.camera_names();
        return scene;
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::OutOfMemory, path + ": not enough memory"};
    } catch (const std::exception& thrown) {
        return Error{ErrorCode::InvalidFile,
                     path + ": not a glTF file that can be read: " + first_line(thrown.what())};
    }
}

#endif

}  // namespace petzval::scene
