// Meshes made by code, and tangents made for them.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>

#include "burnish/scene/scene.h"
#include "error_message.h"

namespace burnish {
namespace {

glm::vec3 face_cross(const Mesh& mesh, size_t i) {
    glm::vec3 a = mesh.positions[mesh.indices[i]];
    return glm::cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a);
}

/// Every triangle has area, faces its vertices' normals, and every frame is orthonormal.
void expect_well_formed(const Mesh& mesh) {
    validate(mesh);
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        glm::vec3 normal = face_cross(mesh, i);
        ASSERT_GT(glm::length(normal), 0.0f) << mesh.name << " triangle " << i / 3;
        glm::vec3 mean = mesh.normals[mesh.indices[i]] + mesh.normals[mesh.indices[i + 1]] +
                         mesh.normals[mesh.indices[i + 2]];
        ASSERT_GT(glm::dot(glm::normalize(normal), glm::normalize(mean)), 0.8f)
            << mesh.name << " triangle " << i / 3;
    }
    ASSERT_EQ(mesh.tangents.size(), mesh.positions.size());
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        ASSERT_NEAR(glm::length(glm::vec3(mesh.tangents[i])), 1.0f, 1e-5f) << i;
        ASSERT_NEAR(glm::dot(glm::vec3(mesh.tangents[i]), mesh.normals[i]), 0.0f, 1e-5f) << i;
        ASSERT_NEAR(glm::length(mesh.normals[i]), 1.0f, 1e-5f) << i;
    }
}

/// A unit square facing +z, uv as a picture lies: u to the right, v downward.
Mesh make_quad() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.normals.assign(4, glm::vec3(0, 0, 1));
    mesh.uv0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

TEST(Mesh, BuiltInMeshesAreWellFormed) {
    for (uint32_t segments : {3u, 16u, 129u}) {
        SCOPED_TRACE(segments);
        if (segments > 3) { // with three segments the chords are far from the surface
            expect_well_formed(make_sphere(2.0f, segments));
            expect_well_formed(make_torus(1.0f, 0.3f, segments));
            expect_well_formed(make_shader_ball(segments));
        }
        expect_well_formed(make_plane(2.0f, segments));
        validate(make_sphere(1.0f, segments));
    }
}

TEST(Mesh, SphereIsExact) {
    Mesh mesh = make_sphere(3.0f, 64);
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        EXPECT_NEAR(glm::length(mesh.positions[i] - 3.0f * mesh.normals[i]), 0.0f, 1e-6f);
        // Longitude grows from +z toward +x.
        glm::vec3 east = glm::normalize(glm::vec3(mesh.tangents[i]));
        EXPECT_NEAR(east.y, 0.0f, 1e-6f);
    }
    EXPECT_EQ(mesh.indices.size() / 3, 64u * (2 * 32 - 2));
}

TEST(Mesh, SegmentsOutOfRangeAreRefused) {
    EXPECT_EQ(message_of([] { make_sphere(1.0f, 2); }), "segments: expected 3..4096, got 2");
    EXPECT_EQ(message_of([] { make_sphere(-1.0f, 8); }), "radius: expected a finite number > 0, got -1");
    EXPECT_EQ(message_of([] { make_torus(1.0f, 2.0f, 8); }),
              "tube_radius: expected a number between 0 and radius = 1, got 2");
}

TEST(Mesh, ValidateNamesTheArray) {
    Mesh mesh = make_quad();
    mesh.indices[4] = 9;
    EXPECT_EQ(message_of([&] { validate(mesh); }), "indices: expected each below the vertex count 4, got 9");
    mesh = make_quad();
    mesh.positions[1].y = std::numeric_limits<float>::infinity();
    EXPECT_EQ(message_of([&] { validate(mesh); }),
              "positions: expected finite numbers, got a non-finite one at 1");
    mesh = make_quad();
    mesh.uv0.pop_back();
    EXPECT_EQ(message_of([&] { validate(mesh); }), "uv0: expected as many as positions (4), got 3");
}

TEST(Mesh, NormalsAreWeightedByArea) {
    Mesh mesh;
    // Two faces meet at vertex 0: one of area 2 facing +z, one of area 0.5 facing +x.
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 1, 0}, {0, 0, 1}, {7, 7, 7}};
    mesh.indices = {0, 1, 2, 0, 3, 4};
    compute_normals(mesh);
    glm::vec3 expected = glm::normalize(glm::vec3(0.5f, 0, 2));
    EXPECT_NEAR(glm::length(mesh.normals[0] - expected), 0.0f, 1e-6f);
    EXPECT_EQ(mesh.normals[5], glm::vec3(0, 0, 1));
}

TEST(Mesh, FlatNormalsSplitVerticesAndDropEmptyTriangles) {
    Mesh mesh = make_quad();
    mesh.positions[3] = {0, 1, 5};
    mesh.indices.insert(mesh.indices.end(), {0, 1, 1});
    compute_flat_normals(mesh);
    EXPECT_EQ(mesh.positions.size(), 6u);
    EXPECT_EQ(mesh.indices, (std::vector<uint32_t>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
    EXPECT_LT(mesh.normals[3].z, 0.5f);
}

TEST(Tangents, FollowUAndGreenPointsToThePicturesTop) {
    Mesh mesh = make_quad();
    compute_tangents(mesh, 0);
    EXPECT_EQ(mesh.positions.size(), 4u);
    for (const glm::vec4& tangent : mesh.tangents)
        EXPECT_EQ(tangent, glm::vec4(1, 0, 0, 1));
    for (glm::vec2& uv : mesh.uv0)
        uv.x = 1.0f - uv.x;
    compute_tangents(mesh, 0);
    for (const glm::vec4& tangent : mesh.tangents)
        EXPECT_EQ(tangent, glm::vec4(-1, 0, 0, -1));
}

TEST(Tangents, FollowTheCoordinatesThatATextureIsReadBy) {
    const auto tangent_of = [](const glm::mat2& scale_rotation) {
        Mesh mesh = make_quad();
        compute_tangents(mesh, 0, scale_rotation);
        EXPECT_EQ(mesh.positions.size(), 4u);
        EXPECT_EQ(mesh.uv0, make_quad().uv0);
        return mesh.tangents[0];
    };
    // u' = v and v' = -u: the picture turns clockwise. By columns.
    EXPECT_EQ(tangent_of({0, -1, 1, 0}), glm::vec4(0, -1, 0, 1));
    EXPECT_EQ(tangent_of({-2, 0, 0, -3}), glm::vec4(-1, 0, 0, 1));
    EXPECT_EQ(tangent_of({-1, 0, 0, 1}), glm::vec4(-1, 0, 0, -1));
    EXPECT_EQ(tangent_of({1, 0, 0, -1}), glm::vec4(1, 0, 0, -1));
    EXPECT_NEAR(glm::length(glm::vec3(tangent_of(glm::mat2(0.0f)))), 1.0f, 1e-6f); // any frame, but a frame
}

TEST(Tangents, MirroredNeighboursSplitTheirSharedVertices) {
    Mesh mesh; // two squares side by side, the texture mirrored at x = 1
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
    mesh.normals.assign(6, glm::vec3(0, 0, 1));
    mesh.uv0 = {{0, 1}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {0, 0}};
    mesh.indices = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
    compute_tangents(mesh, 0);
    EXPECT_EQ(mesh.positions.size(), 8u);
    for (size_t corner = 0; corner < 6; ++corner)
        EXPECT_EQ(mesh.tangents[mesh.indices[corner]], glm::vec4(1, 0, 0, 1)) << corner;
    for (size_t corner = 6; corner < 12; ++corner)
        EXPECT_EQ(mesh.tangents[mesh.indices[corner]], glm::vec4(-1, 0, 0, -1)) << corner;
}

TEST(Tangents, AreWeightedByAngleNotByArea) {
    // Two faces at vertex 0 in one plane: one spans 90 degrees, the other, ten times as large, 45 degrees.
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-10, 10, 0}};
    mesh.normals.assign(4, glm::vec3(0, 0, 1));
    mesh.uv0 = {{0, 0}, {1, 0}, {0, -1}, {-10, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    compute_tangents(mesh, 0);
    // dP/du is (1, 0) on the first; on the second (0, 1) has uv (0, -1) and (-10, 10) has uv (-10, 0): (1,
    // -1).
    glm::vec2 second = glm::normalize(glm::vec2(1, -1));
    glm::vec2 expected =
        glm::normalize(glm::vec2(1, 0) * glm::half_pi<float>() + second * glm::quarter_pi<float>());
    EXPECT_NEAR(mesh.tangents[0].x, expected.x, 1e-5f);
    EXPECT_NEAR(mesh.tangents[0].y, expected.y, 1e-5f);
}

TEST(Tangents, FacesWithoutTextureAreaTakeTheirNeighboursTangent) {
    Mesh mesh = make_quad();
    mesh.uv0[3] = mesh.uv0[0]; // the second triangle has no area in uv
    compute_tangents(mesh, 0);
    for (const glm::vec4& tangent : mesh.tangents) {
        EXPECT_TRUE(std::isfinite(tangent.x));
        EXPECT_EQ(tangent.w, 1.0f);
    }
    EXPECT_NEAR(mesh.tangents[0].x, mesh.tangents[2].x, 1e-6f);
    std::fill(mesh.uv0.begin(), mesh.uv0.end(), glm::vec2(0.5f)); // none has: any frame, but a frame
    compute_tangents(mesh, 0);
    for (size_t i = 0; i < mesh.tangents.size(); ++i) {
        EXPECT_NEAR(glm::length(glm::vec3(mesh.tangents[i])), 1.0f, 1e-6f);
        EXPECT_NEAR(glm::dot(glm::vec3(mesh.tangents[i]), mesh.normals[i]), 0.0f, 1e-6f);
    }
}

TEST(Tangents, MatchThoseOfTheBuiltInSphere) {
    Mesh mesh = make_sphere(1.0f, 96);
    Mesh derived = mesh;
    compute_tangents(derived, 0);
    size_t compared = 0;
    for (size_t corner = 0; corner < mesh.indices.size(); ++corner) {
        glm::vec4 given = mesh.tangents[mesh.indices[corner]],
                  found = derived.tangents[derived.indices[corner]];
        if (std::abs(mesh.positions[mesh.indices[corner]].y) > 0.95f) continue;
        ++compared;
        ASSERT_GT(glm::dot(glm::vec3(given), glm::vec3(found)), 0.995f) << corner;
        ASSERT_EQ(given.w, found.w);
    }
    EXPECT_GT(compared, 1000u);
}

TEST(Tangents, AroundYFollowLongitude) {
    Mesh mesh = make_sphere(1.0f, 48);
    Mesh derived = mesh;
    compute_tangents_around_y(derived);
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        ASSERT_NEAR(glm::length(glm::vec3(derived.tangents[i])), 1.0f, 1e-5f) << i;
        if (std::abs(mesh.positions[i].y) < 0.99f) {
            ASSERT_NEAR(glm::dot(glm::vec3(derived.tangents[i]), glm::vec3(mesh.tangents[i])), 1.0f, 1e-5f)
                << i;
        }
    }
}

TEST(Tangents, NeedTextureCoordinates) {
    Mesh mesh = make_quad();
    EXPECT_EQ(message_of([&] { compute_tangents(mesh, 1); }), "uv1: expected as many as positions, got 0");
}

} // namespace
} // namespace burnish
