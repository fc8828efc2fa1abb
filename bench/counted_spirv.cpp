#include "counted_spirv.h"

#include <array>
#include <initializer_list>
#include <map>
#include <set>

namespace petzval::bench {
namespace {

using Words = std::vector<std::uint32_t>;
using Instruction = std::span<const std::uint32_t>;

// Numbers of the specification of SPIR-V 1.5, and of GLSL.std.450.
enum Op : std::uint32_t {
    kExtInst = 12,
    kEntryPoint = 15,
    kTypeInt = 21,
    kTypeFloat = 22,
    kTypeVector = 23,
    kTypeRuntimeArray = 29,
    kTypeStruct = 30,
    kTypePointer = 32,
    kConstant = 43,
    kConstantComposite = 44,
    kFunction = 54,
    kVariable = 59,
    kLoad = 61,
    kStore = 62,
    kAccessChain = 65,
    kDecorate = 71,
    kMemberDecorate = 72,
    kShuffle = 79,
    kConstruct = 80,
    kExtract = 81,
    kInsert = 82,
    kSampleFirst = 87,
    kFetch = 95,
    kImageGather = 96,
    kImageRead = 98,
    kImageWrite = 99,
    kQueryFirst = 100,
    kConvertFirst = 109,
    kConvertLast = 115,
    kBitcast = 124,
    kFNegate = 127,
    kFAdd = 129,
    kFSub = 131,
    kFMul = 133,
    kDivFirst = 134,
    kDivLast = 141,
    kVectorTimesScalar = 142,
    kMatrixFirst = 143,
    kDot = 148,
    kAny = 154,
    kLogicalFirst = 164,
    kBitLast = 205,
    kBarrier = 224,
    kAtomicFirst = 227,
    kAtomicAdd = 234,
    kAtomicLast = 242,
    kPhi = 245,
    kLabel = 248,
};
constexpr std::uint32_t kStorage = 12, kWorkgroup = 4;  // storage classes
constexpr double kSlow = 4;                             // of units with a quarter of the rate

std::uint32_t op_of(Instruction i) { return i[0] & 0xffffu; }

double of_extended(std::uint32_t number, double parts) {
    static const std::map<std::uint32_t, double> kEach{
        {4, 0},      {13, kSlow}, {14, kSlow}, {25, 12},    {26, 2 * kSlow + 1}, {27, kSlow},
        {28, kSlow}, {29, kSlow}, {30, kSlow}, {31, kSlow}, {32, kSlow},         {43, 1},
        {44, 1},     {45, 1},     {46, 2},     {48, 2},     {49, kSlow + 8}};
    if (number == 66) return parts + kSlow;      // length
    if (number == 67) return 2 * parts + kSlow;  // distance
    if (number == 69) return 2 * parts + kSlow;  // normalize
    const auto known = kEach.find(number);
    return parts * (known == kEach.end() ? 1 : known->second);
}

class Program {
public:
    Program(std::span<const std::uint32_t> words, std::uint32_t first)
        : words_(words), first_(first), bound_(words[3]) {}

    CountedSpirv made() {
        for (std::size_t at = 5; at < words_.size();) {
            const Instruction i = words_.subspan(at, words_[at] >> 16);
            read(i);
            at += i.size();
        }
        CountedSpirv result;
        Words& out = result.words;
        out.assign(words_.begin(), words_.begin() + 5);
        variable_ = fresh();
        bool is_open = false, has_types = false, has_function = false;
        for (std::size_t at = 5; at < words_.size();) {
            const Instruction i = words_.subspan(at, words_[at] >> 16);
            const std::uint32_t op = op_of(i);
            at += i.size();
            if (!has_types && op >= 19 && op <= kVariable) {
                decorate(out);
                has_types = true;
            }
            if (!has_function && op == kFunction) {
                declare(out);
                has_function = true;
            }
            if (is_open && op != kPhi && op != kVariable)
                count(out, std::uint32_t(result.blocks.size()) - 1), is_open = false;
            if (op == kEntryPoint) {
                out.push_back(i[0] + (1u << 16));
                out.insert(out.end(), i.begin() + 1, i.end());
                out.push_back(variable_);
                continue;
            }
            out.insert(out.end(), i.begin(), i.end());
            if (op == kLabel && has_function) is_open = true, result.blocks.emplace_back(), products_.clear();
            if (has_function && !result.blocks.empty()) add(result.blocks.back(), i);
        }
        out[3] = bound_;
        return result;
    }

private:
    std::uint32_t fresh() { return bound_++; }
    void read(Instruction i) {
        switch (op_of(i)) {
            case kTypeInt:
                if (i[2] == 32 && i[3] == 0) uint_ = i[1];
                break;
            case kTypeVector:
                parts_[i[1]] = i[3];
                break;
            case kTypePointer:
                class_of_[i[1]] = i[2];
                break;
            case kConstant:
                constants_.insert(i[2]);
                break;
            case kVariable:
            case kAccessChain:
                pointer_[i[2]] = class_of_[i[1]];
                break;
            default:
                break;
        }
        if (i.size() > 2) type_[i[2]] = i[1];
    }
    static void put(Words& out, std::uint32_t op, std::initializer_list<std::uint32_t> rest) {
        out.push_back(std::uint32_t(rest.size() + 1) << 16 | op);
        out.insert(out.end(), rest);
    }
    void decorate(Words& out) {
        array_ = fresh(), struct_ = fresh();
        put(out, kDecorate, {variable_, 34, 1});         // DescriptorSet
        put(out, kDecorate, {variable_, 33, 0});         // Binding
        put(out, kDecorate, {array_, 6, 4});             // ArrayStride
        put(out, kDecorate, {struct_, 2});               // Block
        put(out, kMemberDecorate, {struct_, 0, 35, 0});  // Offset
    }
    void declare(Words& out) {
        if (uint_ == 0) uint_ = fresh(), put(out, kTypeInt, {uint_, 32, 0});
        const std::uint32_t pointer = fresh();
        element_ = fresh();
        put(out, kTypeRuntimeArray, {array_, uint_});
        put(out, kTypeStruct, {struct_, array_});
        put(out, kTypePointer, {pointer, kStorage, struct_});
        put(out, kTypePointer, {element_, kStorage, uint_});
        put(out, kVariable, {pointer, variable_, kStorage});
        for (std::uint32_t value = 0; value < 2; ++value)
            small_[value] = fresh(), put(out, kConstant, {uint_, small_[value], value});
        std::uint32_t blocks = 0;
        for (std::size_t at = 5; at < words_.size(); at += words_[at] >> 16)
            blocks += (words_[at] & 0xffffu) == kLabel;
        for (std::uint32_t k = 0; k < blocks; ++k)
            numbers_.push_back(fresh()), put(out, kConstant, {uint_, numbers_[k], first_ + k});
    }
    void count(Words& out, std::uint32_t block) {
        const std::uint32_t place = fresh(), before = fresh();
        put(out, kAccessChain, {element_, place, variable_, small_[0], numbers_[block]});
        put(out, kAtomicAdd, {uint_, before, place, small_[1], small_[0], small_[1]});
    }

    double parts_of(std::uint32_t id) const {
        const auto type = type_.find(id);
        if (type == type_.end()) return 1;
        const auto parts = parts_.find(type->second);
        return parts == parts_.end() ? 1 : parts->second;
    }
    void add(BlockWork& work, Instruction i) {
        const std::uint32_t op = op_of(i);
        if (op == kLoad || op == kStore) {
            const auto of = pointer_.find(i[op == kLoad ? 3 : 1]);
            if (of != pointer_.end() && of->second == kStorage) ++work.reads;
            if (of != pointer_.end() && of->second == kWorkgroup) ++work.shared;
        } else if (op >= kAtomicFirst && op <= kAtomicLast) {
            ++work.reads;
        } else if ((op >= kSampleFirst && op <= kFetch) || op == kImageGather || op == kImageRead ||
                   op == kImageWrite) {
            ++work.samples;
        } else if (op == kAccessChain) {
            if (i.size() > 4 && !constants_.contains(i.back()) && pointer_[i[2]] != 7) ++work.operations;
        } else {
            work.operations += of_arithmetic(op, i);
        }
    }
    double of_arithmetic(std::uint32_t op, Instruction i) {
        const double parts = i.size() > 2 ? parts_of(i[2]) : 0;
        if (op == kExtInst) return of_extended(i[4], parts);
        if (op == kFMul || op == kVectorTimesScalar) products_.insert(i[2]);
        if (op == kFAdd || op == kFSub)  // one operation with the product before it
            return products_.erase(i[3]) + products_.erase(i[4]) > 0 ? 0 : parts;
        if (op >= kDivFirst && op <= kDivLast) return parts * (kSlow + 1);
        if (op == kDot) return parts_of(i[3]);
        if ((op >= kQueryFirst && op < kConvertFirst) || op == kBitcast || op == kFNegate) return 0;
        const bool counts = (op >= kConvertFirst && op <= kConvertLast) ||
                            (op >= 126 && op <= kVectorTimesScalar) || (op >= kAny && op <= kBitLast);
        return counts ? parts : 0;
    }

    std::span<const std::uint32_t> words_;
    std::uint32_t first_, bound_, uint_ = 0, variable_ = 0, array_ = 0, struct_ = 0, element_ = 0;
    std::array<std::uint32_t, 2> small_ = {};
    std::vector<std::uint32_t> numbers_;
    std::map<std::uint32_t, std::uint32_t> parts_, class_of_, pointer_, type_;
    std::set<std::uint32_t> constants_, products_;
};

}  // namespace

CountedSpirv counted(std::span<const std::uint32_t> words, std::uint32_t first) {
    return Program(words, first).made();
}

}  // namespace petzval::bench
