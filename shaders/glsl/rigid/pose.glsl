// Transformations between the frame of a pose and the world.
vec3 rotated(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
vec3 toLocal(ColliderPose pose, vec3 x) { return rotated(vec4(-pose.rotation.xyz, pose.rotation.w), x - pose.position.xyz); }
vec3 toWorld(ColliderPose pose, vec3 s) { return rotated(pose.rotation, s) + pose.position.xyz; }
