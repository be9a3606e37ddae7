// Compiles with a warning.
#warning "a remark"

kernel void count_up(global int* value) {
  value[get_global_id(0)] += 1;
}
